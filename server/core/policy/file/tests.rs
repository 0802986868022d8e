use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::geometry::{Point2, Rect};
use crate::image::GrayImage;
use crate::perception::Observation;
use crate::policy::{ACTING_FRACTIONS, Fusion, acting_fractions, images};

type Tensors = Vec<(TensorSpec, Vec<f32>)>;

fn manifest(architecture: Architecture) -> Manifest {
    let (version, observation) = (Manifest::VERSION, [2, 84, 84]);
    Manifest {
        version,
        maps: vec!["colon".to_owned()],
        step_m: 0.01,
        observation,
        architecture,
        clearance_m: 0.008,
        seed: 7,
        revision: "abc".to_owned(),
        updates: 100,
    }
}

fn draw(architecture: &Architecture, seed: u64) -> Tensors {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    architecture.tensors().into_iter().map(|spec| (spec.clone(), spec.draw(&mut rng))).collect()
}

/// The tensors of a file without noise parameters.
fn kept() -> Tensors {
    draw(&Architecture { noisy: false, ..Architecture::default() }, 1)
}

/// A file with any content, as another program could write it.
fn file(manifest: &str, tensors: &Tensors) -> Vec<u8> {
    let bytes = |values: &Vec<f32>| values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>();
    let data: Vec<_> = tensors.iter().map(|(spec, values)| (spec, bytes(values))).collect();
    let views = data.iter().map(|(spec, bytes)| {
        (
            &spec.name,
            TensorView::new(Dtype::F32, spec.shape.clone(), bytes).expect("the number of values fits the shape"),
        )
    });
    safetensors::serialize(views, Some(HashMap::from([(KEY.to_owned(), manifest.to_owned())]))).unwrap()
}

fn file_of(manifest: &Manifest, tensors: &Tensors) -> Vec<u8> {
    file(&serde_json::to_string(manifest).unwrap(), tensors)
}

fn plain() -> Manifest {
    manifest(Architecture { noisy: false, ..Architecture::default() })
}

fn refusal(bytes: &[u8]) -> String {
    Policy::from_bytes(bytes).unwrap_err().to_string()
}

fn observation() -> Observation {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let gray = GrayImage { width_px: 480, height_px: 480, pixels: (0..480 * 480).map(|_| rng.random()).collect() };
    let workspace = Rect { x_min_m: 0.0, x_max_m: 0.6, y_min_m: 0.0, y_max_m: 0.4 };
    Observation::new(&gray, Some(Point2::new(0.5, 0.1)), Point2::new(0.1, 0.3), &workspace)
}

#[test]
fn a_written_policy_judges_like_the_trained_network() {
    let full = Architecture::default();
    for architecture in
        [full, Architecture { fusion: Fusion::Early, ..full }, Architecture { quantiles: false, ..full }]
    {
        let weights = draw(&architecture, 3);
        let bytes = Policy::to_bytes(&manifest(architecture), &weights).unwrap();
        let policy = Policy::from_bytes(&bytes).unwrap();
        let expected = manifest(Architecture { noisy: false, ..architecture });
        assert_eq!(policy.manifest(), &expected, "acting does not need noise");

        let tensors = weights.iter().map(|(spec, values)| {
            (spec.name.clone(), Tensor::from_slice(values, spec.shape.clone(), &Device::Cpu).unwrap())
        });
        let network = Network::new(architecture, &builder(tensors.collect()));
        let (network, seen) = (network.unwrap(), observation());
        let features = network.features(&images([&seen.bytes[..]].into_iter(), architecture.channels()).unwrap());
        let places = Tensor::from_slice(&seen.places(), (1, 1, 4), &Device::Cpu).unwrap();
        let fractions = acting_fractions(1, ACTING_FRACTIONS).unwrap();
        let quantiles = network.quantiles(&features.unwrap(), &places, &fractions, None).unwrap();
        let quantiles: Vec<Vec<f32>> = quantiles.squeeze(0).unwrap().squeeze(0).unwrap().to_vec2().unwrap();
        let judged = policy.judge(&seen).unwrap();
        assert_eq!(quantiles.len(), if architecture.quantiles { ACTING_FRACTIONS } else { 1 });
        for (action, row) in judged.quantiles.iter().enumerate() {
            assert_eq!(*row, quantiles.iter().map(|values| values[action]).collect::<Vec<_>>());
        }
        assert!(judged.values().windows(2).any(|pair| pair[0] != pair[1]));
    }
}

#[test]
fn refuses_a_tensor_that_does_not_fit_and_names_it() {
    assert!(Policy::from_bytes(&file_of(&plain(), &kept())).is_ok());

    // Two channels in the first convolution, but the manifest says that the trunk uses one.
    let mut tensors = kept();
    tensors[0] = draw(&Architecture { fusion: Fusion::Early, ..plain().architecture }, 1).remove(0);
    let text = refusal(&file_of(&plain(), &tensors));
    assert!(
        text.contains(
            "\"trunk.patches.weight\" is [98, 32] of F32, the observation and the network need [49, 32] of f32"
        ),
        "{text}"
    );

    for index in 0..kept().len() {
        let mut tensors = kept();
        let name = tensors.remove(index).0.name;
        assert_eq!(refusal(&file_of(&plain(), &tensors)), format!("policy: tensor {name:?} is missing"));
    }

    let mut tensors = kept();
    let spec = TensorSpec { name: "trunk.extra".to_owned(), ..tensors[1].0.clone() };
    tensors.push((spec, tensors[1].1.clone()));
    assert_eq!(refusal(&file_of(&plain(), &tensors)), "policy: tensor \"trunk.extra\" is not part of the network");
    // Tensors of a part that the manifest switches off are refused too.
    let no_duel = manifest(Architecture { dueling: false, ..plain().architecture });
    assert!(refusal(&file_of(&no_duel, &kept())).contains("\"value."));

    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 3e38, -1.1e4] {
        let mut tensors = kept();
        *tensors[5].1.last_mut().unwrap() = value;
        let name = &tensors[5].0.name;
        let expected = format!("policy: tensor {name:?} contains {value}, it must be -10000 to 10000");
        assert_eq!(refusal(&file_of(&plain(), &tensors)), expected);
    }

    // Integers, with the same number of bytes.
    let data: Vec<u8> = vec![0; 4 * 49 * 32];
    let integers = TensorView::new(Dtype::I32, vec![49, 32], &data).unwrap();
    let metadata = HashMap::from([(KEY.to_owned(), serde_json::to_string(&plain()).unwrap())]);
    let text = refusal(&safetensors::serialize([("trunk.patches.weight", integers)], Some(metadata)).unwrap());
    assert!(text.contains("\"trunk.patches.weight\" is [49, 32] of I32"), "{text}");
}

#[test]
fn refuses_a_tensor_that_is_in_the_header_twice() {
    let bytes = file_of(&plain(), &kept());
    let header = u64::from_le_bytes(*bytes.first_chunk().unwrap()) as usize;
    let text = std::str::from_utf8(&bytes[8..8 + header]).unwrap();
    // The same place again, so that only the name is wrong.
    let name = "\"trunk.patches.bias\":";
    let begin = text.find(name).unwrap();
    let entry = &text[begin..begin + text[begin..].find('}').unwrap() + 1];
    let doubled = text.replacen(entry, &format!("{entry},{entry}"), 1);
    let length = (doubled.len() as u64).to_le_bytes();
    let found = refusal(&[&length[..], doubled.as_bytes(), &bytes[8 + header..]].concat());
    assert_eq!(found, "policy: tensor \"trunk.patches.bias\" is in the file twice");
}

#[test]
fn refuses_a_manifest_that_does_not_fit_and_gives_the_reason() {
    let (version, [channels, height, width]) = (Manifest::VERSION, Manifest::observation(&Architecture::default()));
    let cases = [
        (Manifest { version: version + 1, ..plain() }, "version is 2, expected 1"),
        (Manifest { observation: [channels + 1, height, width], ..plain() }, "observation is [3, 84, 84]"),
        (Manifest { observation: [channels, height, 96], ..plain() }, "observation is [2, 84, 96]"),
        (Manifest { step_m: 0.0, ..plain() }, "step_m is 0"),
        (Manifest { step_m: 1.0, ..plain() }, "step_m is 1, it must be 0.001 to 0.1"),
        (Manifest { clearance_m: -0.001, ..plain() }, "clearance_m is -0.001"),
        // Each cell of the map would look at the whole map.
        (Manifest { clearance_m: 5.008, ..plain() }, "clearance_m is 5.008, it must be 0 to 0.1"),
    ];
    for (manifest, reason) in cases {
        let text = refusal(&file_of(&manifest, &kept()));
        assert!(text.starts_with("policy: manifest: ") && text.contains(reason), "{text}");
    }
    for (text, reason) in [("", "EOF"), ("{}", "missing field `version`"), ("[1]", "invalid length")] {
        let found = refusal(&file(text, &kept()));
        assert!(found.starts_with("policy: manifest: ") && found.contains(reason), "{found}");
    }
    let stray = serde_json::to_string(&plain()).unwrap().replace("\"seed\"", "\"sead\"");
    assert!(refusal(&file(&stray, &kept())).contains("unknown field `sead`"));
    // Without a manifest, as other programs write weights.
    let data = [0; 4];
    let view = TensorView::new(Dtype::F32, vec![1], &data).unwrap();
    let text = refusal(&safetensors::serialize([("x", view)], None).unwrap());
    assert!(text.contains("the metadata has no \"ferry\""), "{text}");
}

#[test]
fn refuses_a_number_of_the_manifest_by_its_field() {
    let fields = ["version", "step_m", "clearance_m", "seed", "updates"];
    for (field, number) in fields.iter().flat_map(|field| ["1e300", "-1", "1e999"].map(|number| (field, number))) {
        let mut manifest = serde_json::to_value(plain()).unwrap();
        manifest[field] = "HERE".into();
        let found = refusal(&file(&manifest.to_string().replace("\"HERE\"", number), &kept()));
        assert!(found.starts_with(&format!("policy: manifest: {field}")), "{field} = {number}: {found}");
    }
    let twice = format!("{0} {0}", serde_json::to_string(&plain()).unwrap());
    assert!(refusal(&file(&twice, &kept())).contains("trailing characters"));
}

#[test]
fn names_the_format_of_a_file_of_another_program() {
    for (bytes, kind) in [
        (&b"\x08\x07\x12\x07pytorch\x1a\x052.0.0"[..], "an ONNX model"),
        (b"\x08\x0a\x3a\x80\x02graph", "an ONNX model"),
        (b"PK\x03\x04\x00\x00\x08\x08archive/data.pkl", "a zip archive"),
        (b"\x80\x02\x8a\nl\xfc\x9cF\xf9 j\xa8P\x19.", "a Python pickle"),
        (b"\x89HDF\r\n\x1a\n", "an HDF5 file"),
    ] {
        let found = refusal(bytes);
        assert!(found.contains(kind) && found.contains("`ferry train`"), "{found}");
    }
}

#[test]
fn refuses_a_header_with_a_large_claimed_size_before_parsing() {
    let mut bytes = file_of(&plain(), &kept());
    for claimed in [MAX_HEADER_BYTES + 1, 100 << 30, u64::MAX] {
        bytes[..8].copy_from_slice(&claimed.to_le_bytes());
        let error = Policy::from_bytes(&bytes).unwrap_err();
        assert!(matches!(error, PolicyError::Header { bytes } if bytes == claimed), "{error}");
    }
    // A tensor with a claimed size of a hundred gigabytes.
    let header = br#"{"x":{"dtype":"F32","shape":[26843545600],"data_offsets":[0,107374182400]}}"#;
    let bytes = [&(header.len() as u64).to_le_bytes()[..], header, &[0; 64]].concat();
    assert!(matches!(Policy::from_bytes(&bytes), Err(PolicyError::Format(_))));
}

#[test]
fn truncated_and_damaged_files_are_read_or_refused_without_panic() {
    let bytes = file_of(&plain(), &kept());
    let header = 8 + u64::from_le_bytes(*bytes.first_chunk().unwrap()) as usize;
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    for length in (0..20).chain((0..200).map(|_| rng.random_range(0..bytes.len()))).chain([header, bytes.len() - 1]) {
        assert!(matches!(Policy::from_bytes(&bytes[..length]), Err(PolicyError::Format(_))), "{length} bytes");
    }
    assert!(Policy::from_bytes(&[&bytes[..], &[0]].concat()).is_err(), "one additional byte");
    let (seen, mut whole) = (observation(), 0);
    for round in 0..600 {
        let mut damaged = bytes.clone();
        for _ in 0..rng.random_range(1..4) {
            // Damage mostly the header, because other bytes are only numbers.
            let at = if round % 4 > 0 { rng.random_range(0..header) } else { rng.random_range(header..bytes.len()) };
            damaged[at] = if rng.random() { rng.random() } else { damaged[at] ^ (1 << rng.random_range(0..8)) };
        }
        if let Ok(policy) = Policy::from_bytes(&damaged) {
            whole += 1;
            policy.judge(&seen).unwrap();
        }
    }
    assert!((50..400).contains(&whole), "{whole}");
}
