use std::collections::HashMap;

use candle_core::Var;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::*;

const FULL: Architecture = Architecture {
    fusion: Fusion::Late,
    quantiles: true,
    dueling: true,
    noisy: true,
    residual: true,
    survey: SurveyParts::ALL,
};

/// All parts, then each one switched off.
const ALL: [Architecture; 6] = [
    FULL,
    Architecture { fusion: Fusion::Early, ..FULL },
    Architecture { dueling: false, ..FULL },
    Architecture { noisy: false, ..FULL },
    Architecture { quantiles: false, ..FULL },
    Architecture { residual: false, ..FULL },
];

type Weights = HashMap<String, Vec<f32>>;

fn draw_weights(architecture: &Architecture, seed: u64) -> Weights {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    architecture.tensors().iter().map(|spec| (spec.name.clone(), spec.draw(&mut rng))).collect()
}

fn variables(architecture: &Architecture, weights: &Weights) -> HashMap<String, Var> {
    let var = |spec: &TensorSpec| Var::from_slice(&weights[&spec.name], spec.shape.clone(), &Device::Cpu).unwrap();
    architecture.tensors().iter().map(|spec| (spec.name.clone(), var(spec))).collect()
}

fn network(architecture: &Architecture, weights: &Weights) -> Network {
    let variables = variables(architecture, weights);
    let detached = variables.into_iter().map(|(name, variable)| (name, variable.as_detached_tensor()));
    Network::new(*architecture, &builder(detached.collect())).unwrap()
}

fn uniform(rng: &mut ChaCha8Rng, shape: &[usize]) -> Tensor {
    let values: Vec<f32> = (0..shape.iter().product()).map(|_| rng.random()).collect();
    Tensor::from_vec(values, shape, &Device::Cpu).unwrap()
}

fn flat(tensor: &Tensor) -> Vec<f32> {
    tensor.flatten_all().unwrap().to_vec1().unwrap()
}

/// Tolerance for sums of about a hundred terms in a different order.
fn assert_near(a: &Tensor, b: &Tensor) {
    assert_eq!(a.dims(), b.dims());
    for (a, b) in flat(a).into_iter().zip(flat(b)) {
        assert!((a - b).abs() < 1e-5, "{a} {b}");
    }
}

/// Images, places, fractions and noise for two images, three goals (one with early fusion) and four fractions.
struct Example {
    images: Tensor,
    places: Tensor,
    fractions: Tensor,
    noise: Option<Noise>,
}

impl Example {
    fn new(architecture: &Architecture, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let goals = if architecture.fusion == Fusion::Early { 1 } else { 3 };
        Self {
            images: uniform(&mut rng, &[2, 84, 84, architecture.channels()]),
            places: uniform(&mut rng, &[2, goals, 4]),
            fractions: uniform(&mut rng, &[2, 4]),
            noise: architecture.draw_noise(&mut rng).unwrap(),
        }
    }

    fn quantiles(&self, network: &Network) -> Tensor {
        let features = network.features(&self.images).unwrap();
        network.quantiles(&features, &self.places, &self.fractions, self.noise.as_ref()).unwrap()
    }
}

#[test]
fn noise_has_the_moments_of_the_publication_and_rank_one() {
    const DRAWS: usize = 1000;
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let layers = FULL.head();
    // For each layer: Σ ε_w, Σ ε_w², Σ ε_b, Σ ε_b².
    let mut sums = vec![[0.0f64; 4]; layers.len()];
    for draw in 0..DRAWS {
        let Noise(noise) = FULL.draw_noise(&mut rng).unwrap().unwrap();
        assert_eq!(noise.len(), layers.len());
        for ((noise, &(_, inputs, outputs)), sums) in noise.iter().zip(&layers).zip(&mut sums) {
            assert_eq!((noise.weight.dims(), noise.bias.dims()), (&[inputs, outputs][..], &[outputs][..]));
            let (weight, bias) = (flat(&noise.weight), flat(&noise.bias));
            for (sums, values) in sums.chunks_exact_mut(2).zip([&weight, &bias]) {
                sums[0] += values.iter().map(|&x| f64::from(x)).sum::<f64>() / values.len() as f64;
                sums[1] += values.iter().map(|&x| f64::from(x * x)).sum::<f64>() / values.len() as f64;
            }
            if draw < 10 {
                // ε_ij = f(ε_i)·f(ε_j), and the bias has the same f(ε_j).
                for (row, j) in (0..inputs).zip((0..outputs).cycle()) {
                    let (row, scale) = (&weight[row * outputs..(row + 1) * outputs], bias[j]);
                    for (&w, &b) in row.iter().zip(&bias) {
                        assert!((w * scale - row[j] * b).abs() < 1e-5);
                    }
                }
            }
        }
    }
    // E|x| and E|x|² of a standard normal x. For each layer, the tolerance of the mean is five deviations.
    let mean = (2.0 / std::f64::consts::PI).sqrt();
    for (sums, (name, inputs, outputs)) in sums.into_iter().zip(layers) {
        let [w, w2, b, b2] = sums.map(|sum| sum / DRAWS as f64);
        let (inputs, outputs, draws) = (inputs as f64, outputs as f64, DRAWS as f64);
        let root = |variance: f64| 5.0 * (variance / draws).sqrt();
        assert!(w.abs() < root(mean * mean / (inputs * outputs)), "{name} {w}");
        assert!(b.abs() < root(mean / outputs), "{name} {b}");
        let spread = 1.0 - mean * mean;
        assert!((b2 - mean).abs() < root(spread / outputs), "{name} {b2}");
        let variance = mean * mean * spread * (1.0 / inputs + 1.0 / outputs) + spread * spread / (inputs * outputs);
        assert!((w2 - mean * mean).abs() < root(variance), "{name} {w2}");
    }
}

#[test]
fn initial_weights_follow_fortunato_and_others() {
    for architecture in ALL {
        let weights = draw_weights(&architecture, 3);
        let mut noisy = 0;
        for spec in architecture.tensors() {
            let (layer, kind) = spec.name.rsplit_once('.').unwrap();
            let of_layer = |other: &TensorSpec| other.name == format!("{layer}.weight");
            let inputs = architecture.tensors().into_iter().find(of_layer).unwrap().shape[0] as f32;
            let values = &weights[&spec.name];
            assert_eq!(values.len(), spec.shape.iter().product::<usize>());
            if kind.ends_with("_sigma") {
                noisy += 1;
                assert!(values.iter().all(|&value| (value - 0.5 / inputs.sqrt()).abs() < 1e-7), "{}", spec.name);
                continue;
            }
            let max = 1.0 / inputs.sqrt();
            assert!(values.iter().all(|value| value.abs() <= max), "{}", spec.name);
            if values.len() >= 1000 {
                // Uniform: the mean square is a third of the squared limit, within 10 %, and the values come near the
                // limits.
                let square = values.iter().map(|value| value * value).sum::<f32>() / values.len() as f32;
                assert!((square * 3.0 / (max * max) - 1.0).abs() < 0.1, "{} {square}", spec.name);
                assert!(values.iter().any(|&v| v > 0.98 * max) && values.iter().any(|&v| v < -0.98 * max));
            }
        }
        let heads = if architecture.dueling { 4 } else { 2 };
        assert_eq!(noisy, if architecture.noisy { 2 * heads } else { 0 });
    }
}

#[test]
fn without_noise_the_means_are_used_and_two_draws_differ() {
    let weights = draw_weights(&FULL, 4);
    let example = Example::new(&FULL, 5);
    let noisy = network(&FULL, &weights);
    let plain = network(&Architecture { noisy: false, ..FULL }, &weights);
    let quiet = Example { noise: None, ..Example::new(&FULL, 5) };
    assert_eq!(flat(&quiet.quantiles(&noisy)), flat(&quiet.quantiles(&plain)));
    // Equal seeds draw equal noise; noise with σ = 0 has no effect.
    assert_eq!(flat(&example.quantiles(&noisy)), flat(&Example::new(&FULL, 5).quantiles(&noisy)));
    let still = weights.iter().map(|(name, values)| {
        let factor = f32::from(u8::from(!name.ends_with("_sigma")));
        (name.clone(), values.iter().map(|value| value * factor).collect())
    });
    let still = network(&FULL, &still.collect());
    assert_eq!(flat(&example.quantiles(&still)), flat(&quiet.quantiles(&plain)));

    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let [first, second] = [(), ()].map(|()| {
        let noise = FULL.draw_noise(&mut rng).unwrap();
        flat(&Example { noise, ..Example::new(&FULL, 5) }.quantiles(&noisy))
    });
    let differing = first.iter().zip(&second).filter(|(a, b)| (*a - *b).abs() > 1e-3).count();
    assert!(differing > first.len() / 2, "{differing} of {}", first.len());
    assert!(Architecture { noisy: false, ..FULL }.draw_noise(&mut rng).unwrap().is_none());
}

#[test]
fn with_dueling_the_mean_over_the_actions_is_the_value() {
    let mut weights = draw_weights(&FULL, 7);
    let example = Example::new(&FULL, 8);
    let out = example.quantiles(&network(&FULL, &weights));
    let means = out.mean_keepdim(D::Minus1).unwrap();
    assert!(flat(&out).iter().zip(flat(&means.broadcast_as(out.dims()).unwrap())).any(|(a, b)| (a - b).abs() > 1e-2));

    // An advantage that is equal for all actions has no effect.
    weights.get_mut("advantage.out.bias").unwrap().iter_mut().for_each(|bias| *bias += 3.0);
    assert_near(&example.quantiles(&network(&FULL, &weights)), &out);
    // Without an advantage every action has the value.
    let advantage = weights.iter_mut().filter(|(name, _)| name.starts_with("advantage.out."));
    advantage.for_each(|(_, values)| values.fill(0.0));
    let value = example.quantiles(&network(&FULL, &weights));
    assert_near(&value, &means.broadcast_as(out.dims()).unwrap());
    // The value is used: it shifts all actions equally.
    weights.get_mut("value.out.bias").unwrap()[0] += 0.5;
    assert_near(&example.quantiles(&network(&FULL, &weights)), &(value + 0.5).unwrap());
}

#[test]
fn a_quantile_does_not_depend_on_the_others() {
    let example = Example::new(&FULL, 9);
    let network = network(&FULL, &draw_weights(&FULL, 10));
    let all = example.quantiles(&network);
    for index in 0..4 {
        let fractions = example.fractions.narrow(1, index, 1).unwrap();
        let alone = Example { fractions, ..Example::new(&FULL, 9) }.quantiles(&network);
        assert_near(&alone, &all.narrow(2, index, 1).unwrap());
    }
    let [first, second] = [0, 1].map(|index| flat(&all.narrow(2, index, 1).unwrap()));
    assert!(first.iter().zip(&second).any(|(a, b)| (a - b).abs() > 1e-4), "it depends on its own fraction");
}

#[test]
fn an_image_has_the_same_result_alone_and_in_a_batch() {
    for architecture in [FULL, ALL[1]] {
        let network = network(&architecture, &draw_weights(&architecture, 11));
        let mut rng = ChaCha8Rng::seed_from_u64(12);
        let images = uniform(&mut rng, &[5, 84, 84, architecture.channels()]);
        let together = network.features(&images).unwrap();
        for index in 0..5 {
            let alone = network.features(&images.narrow(0, index, 1).unwrap()).unwrap();
            assert_near(&alone, &together.narrow(0, index, 1).unwrap());
        }
    }
}

#[test]
fn late_fusion_gives_the_same_for_many_goals_as_for_each() {
    let example = Example::new(&FULL, 13);
    let network = network(&FULL, &draw_weights(&FULL, 14));
    let together = example.quantiles(&network);
    assert_eq!(together.dims(), [2, 3, 4, 4]);
    for goal in 0..3 {
        let places = example.places.narrow(1, goal, 1).unwrap();
        let alone = Example { places, ..Example::new(&FULL, 13) }.quantiles(&network);
        assert_near(&alone, &together.narrow(1, goal, 1).unwrap());
    }
    let [first, second] = [0, 1].map(|goal| flat(&together.narrow(1, goal, 1).unwrap()));
    assert!(first.iter().zip(&second).any(|(a, b)| (a - b).abs() > 1e-4), "the goal matters");
}

#[test]
fn early_fusion_uses_both_channels_and_has_no_separate_places() {
    let early = ALL[1];
    let patches = |architecture: &Architecture| architecture.tensors()[0].clone();
    assert_eq!((patches(&early).name.as_str(), patches(&early).shape), ("trunk.patches.weight", vec![7 * 7 * 2, 32]));
    assert_eq!(patches(&FULL).shape, [7 * 7, 32]);
    assert!(early.tensors().iter().all(|spec| !spec.name.contains("place")));
    let example = Example::new(&early, 15);
    let network = network(&early, &draw_weights(&early, 16));
    let other = Example::new(&early, 17);
    let [first, second] = [0, 1].map(|channel| {
        let mut planes = [0, 1].map(|index| example.images.narrow(3, index, 1).unwrap());
        planes[channel] = other.images.narrow(3, channel, 1).unwrap();
        network.features(&Tensor::cat(&planes, 3).unwrap()).unwrap()
    });
    let whole = flat(&network.features(&example.images).unwrap());
    for changed in [first, second] {
        assert!(flat(&changed).iter().zip(&whole).any(|(a, b)| (a - b).abs() > 1e-3));
    }
}

#[test]
fn the_gradient_of_every_weight_is_the_slope_of_the_network() {
    for architecture in ALL {
        let mut weights = draw_weights(&architecture, 18);
        let example = Example::new(&architecture, 19);
        let variables = variables(&architecture, &weights);
        let taped = variables.iter().map(|(name, variable)| (name.clone(), variable.as_tensor().clone()));
        let taped = Network::new(architecture, &builder(taped.collect())).unwrap();
        let out = example.quantiles(&taped);
        let mut rng = ChaCha8Rng::seed_from_u64(20);
        let factors = (uniform(&mut rng, out.dims()) - 0.5).unwrap();
        let gradients = (out * &factors).unwrap().sum_all().unwrap().backward().unwrap();
        let factors = flat(&factors);
        // Summed in double precision, so that only the network rounds.
        let loss = |weights: &Weights| {
            let out = flat(&example.quantiles(&network(&architecture, weights)));
            out.iter().zip(&factors).map(|(&y, &f)| f64::from(y) * f64::from(f)).sum::<f64>()
        };
        for spec in architecture.tensors() {
            let gradient = flat(gradients.get(&variables[&spec.name]).unwrap());
            // The steepest of its weights, and a random one.
            let steepest =
                (0..gradient.len()).max_by(|&a, &b| gradient[a].abs().total_cmp(&gradient[b].abs())).unwrap();
            assert!(gradient[steepest] != 0.0, "{} {architecture:?}", spec.name);
            for index in [steepest, rng.random_range(0..gradient.len())] {
                const STEP: f32 = 5e-4;
                let kept = weights[&spec.name][index];
                let [above, here, below] = [STEP, 0.0, -STEP].map(|step| {
                    weights.get_mut(&spec.name).unwrap()[index] = kept + step;
                    loss(&weights)
                });
                weights.get_mut(&spec.name).unwrap()[index] = kept;
                let slopes = [above - here, here - below].map(|rise| rise / f64::from(STEP));
                // If a ReLU switches within the step the slopes differ, and the gradient is one of them. Rounding
                // errors are about 2e-4.
                let given = f64::from(gradient[index]);
                let slack = 1e-3 + 0.02 * given.abs();
                let [low, high] = [slopes[0].min(slopes[1]) - slack, slopes[0].max(slopes[1]) + slack];
                assert!((low..high).contains(&given), "{}[{index}]: {slopes:?} {given} {architecture:?}", spec.name);
            }
        }
    }
}
