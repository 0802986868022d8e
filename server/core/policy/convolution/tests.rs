use candle_core::{Device, Var};

use super::*;

const CASES: [(Convolution, [usize; 4], usize); 9] = [
    (convolution(7, 7, 0, false), [3, 84, 84, 1], 32),
    (convolution(7, 7, 0, false), [2, 84, 84, 2], 32),
    (convolution(3, 1, 1, true), [5, 12, 12, 32], 32),
    (convolution(3, 2, 1, false), [35, 12, 12, 32], 32),
    (convolution(3, 1, 1, true), [35, 6, 6, 32], 32),
    (convolution(3, 2, 0, true), [4, 8, 9, 3], 5),
    (convolution(1, 1, 0, false), [2, 5, 4, 3], 1),
    (convolution(2, 1, 3, true), [1, 4, 5, 2], 7),
    (convolution(4, 3, 2, false), [17, 7, 10, 3], 4),
];

const fn convolution(kernel: usize, stride: usize, padding: usize, rectify_input: bool) -> Convolution {
    Convolution { kernel, stride, padding, rectify_input }
}

fn arguments(convolution: Convolution, shape: [usize; 4], channels_out: usize) -> Result<[Var; 3]> {
    let window_len = convolution.kernel * convolution.kernel * shape[3];
    let scale = 1.0 / (window_len as f32).sqrt();
    Ok([
        Var::randn(0f32, 1.0, &shape, &Device::Cpu)?,
        Var::randn(0f32, scale, (window_len, channels_out), &Device::Cpu)?,
        Var::randn(0f32, 1.0, channels_out, &Device::Cpu)?,
    ])
}

/// The same convolution by candle's own operations.
fn reference(convolution: Convolution, x: &Tensor, weight: &Tensor, bias: &Tensor) -> Result<Tensor> {
    let Convolution { kernel, stride, padding, rectify_input } = convolution;
    let (channels_in, channels_out) = (x.dim(3)?, weight.dim(1)?);
    let x = if rectify_input { x.relu()? } else { x.clone() };
    // Candle's backward pass requires equal numbers of unused rows and columns; without padding there can be none.
    let used = |side: usize| if padding == 0 { (side - kernel) / stride * stride + kernel } else { side };
    let x = x.narrow(1, 0, used(x.dim(1)?))?.narrow(2, 0, used(x.dim(2)?))?;
    let weight = weight.reshape((kernel, kernel, channels_in, channels_out))?.permute((3, 2, 0, 1))?.contiguous()?;
    let y = x.permute((0, 3, 1, 2))?.contiguous()?.conv2d(&weight, padding, stride, 1, 1)?;
    y.permute((0, 2, 3, 1))?.contiguous()?.broadcast_add(bias)
}

fn assert_close(actual: &Tensor, expected: &Tensor) -> Result<()> {
    assert_eq!(actual.dims(), expected.dims());
    let difference = (actual - expected)?.abs()?.flatten_all()?.max(0)?.to_scalar::<f32>()?;
    let magnitude = expected.abs()?.flatten_all()?.max(0)?.to_scalar::<f32>()?;
    assert!(difference <= 2e-5 * magnitude.max(1.0), "differs by {difference}, the largest value is {magnitude}");
    Ok(())
}

fn bits(tensor: &Tensor) -> Result<Vec<u32>> {
    Ok(tensor.flatten_all()?.to_vec1::<f32>()?.into_iter().map(f32::to_bits).collect())
}

/// A loss whose gradient with respect to `y` is not constant.
fn loss(y: &Tensor) -> Result<Tensor> {
    (y.sqr()? + y)?.sum_all()
}

#[test]
fn agrees_with_candle() -> Result<()> {
    for (convolution, shape, channels_out) in CASES {
        let [x, weight, bias] = arguments(convolution, shape, channels_out)?;
        let actual = convolution.forward(&x, &weight, &bias)?;
        let expected = reference(convolution, &x, &weight, &bias)?;
        assert_close(&actual, &expected)?;
        let actual = loss(&actual)?.backward()?;
        let expected = loss(&expected)?.backward()?;
        for argument in [&x, &weight, &bias] {
            assert_close(actual.get(argument).unwrap(), expected.get(argument).unwrap())?;
        }
    }
    Ok(())
}

#[test]
fn accepts_strided_arguments() -> Result<()> {
    let convolution = convolution(3, 1, 1, true);
    let x = Var::randn(0f32, 1.0, (2, 4, 6, 5), &Device::Cpu)?;
    let weight = Var::randn(0f32, 1.0, (3, 36), &Device::Cpu)?;
    let bias = Var::randn(0f32, 1.0, 6, &Device::Cpu)?;
    let [x_view, weight_view, bias_view] = [x.permute((0, 2, 3, 1))?, weight.t()?, bias.narrow(0, 2, 3)?];
    let actual = convolution.forward(&x_view, &weight_view, &bias_view)?;
    let expected = reference(convolution, &x_view, &weight_view, &bias_view)?;
    assert_close(&actual, &expected)?;
    let actual = loss(&actual)?.backward()?;
    let expected = loss(&expected)?.backward()?;
    for argument in [&x, &weight, &bias] {
        assert_close(actual.get(argument).unwrap(), expected.get(argument).unwrap())?;
    }
    Ok(())
}

#[test]
fn is_bit_identical_for_any_number_of_threads() -> Result<()> {
    for (convolution, shape, channels_out) in CASES {
        let arguments = arguments(convolution, shape, channels_out)?;
        let run = |threads: usize| -> Result<Vec<Vec<u32>>> {
            let [x, weight, bias] = &arguments;
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| {
                let y = convolution.forward(x, weight, bias)?;
                let gradients = loss(&y)?.backward()?;
                let gradients = arguments.iter().map(|argument| bits(gradients.get(argument).unwrap()));
                std::iter::once(bits(&y)).chain(gradients).collect()
            })
        };
        let expected = run(1)?;
        assert!((0..4).all(|_| run(2).unwrap() == expected), "{convolution:?} on {shape:?}");
    }
    Ok(())
}

#[test]
fn a_batch_is_bit_identical_to_its_images() -> Result<()> {
    for (convolution, shape, channels_out) in CASES {
        let [x, weight, bias] = arguments(convolution, shape, channels_out)?;
        let together = convolution.forward(&x, &weight, &bias)?;
        for image in 0..shape[0] {
            let alone = convolution.forward(&x.narrow(0, image, 1)?, &weight, &bias)?;
            assert_eq!(bits(&alone)?, bits(&together.narrow(0, image, 1)?)?);
        }
    }
    Ok(())
}

#[test]
fn only_tracked_arguments_get_a_gradient() -> Result<()> {
    let convolution = convolution(3, 1, 1, true);
    let [x, weight, bias] = arguments(convolution, [2, 5, 5, 3], 4)?;
    let expected = loss(&convolution.forward(&x, &weight, &bias)?)?.backward()?;
    for tracked in [[false, true, true], [true, false, false], [false, false, true]] {
        let arguments = [&x, &weight, &bias].map(|argument| argument.as_tensor());
        let detached = std::array::from_fn(|i| if tracked[i] { arguments[i].clone() } else { arguments[i].detach() });
        let [x, weight, bias]: [Tensor; 3] = detached;
        let gradients = loss(&convolution.forward(&x, &weight, &bias)?)?.backward()?;
        for (i, argument) in [x, weight, bias].iter().enumerate() {
            let expected = tracked[i].then(|| bits(expected.get(arguments[i]).unwrap()).unwrap());
            assert_eq!(gradients.get(argument).map(|gradient| bits(gradient).unwrap()), expected);
        }
    }
    Ok(())
}

#[test]
fn an_empty_batch_is_not_an_error() -> Result<()> {
    let convolution = convolution(3, 1, 1, false);
    let [_, weight, bias] = arguments(convolution, [1, 5, 5, 3], 4)?;
    let x = Var::zeros((0, 5, 5, 3), candle_core::DType::F32, &Device::Cpu)?;
    let y = convolution.forward(&x, &weight, &bias)?;
    assert_eq!(y.dims(), [0, 5, 5, 4]);
    let gradients = y.sum_all()?.backward()?;
    assert_eq!(bits(gradients.get(&bias).unwrap())?, [0; 4]);
    assert_eq!(bits(gradients.get(&weight).unwrap())?, [0; 108]);
    Ok(())
}

#[test]
fn keeps_nan() -> Result<()> {
    let convolution = convolution(1, 1, 0, true);
    let x = Tensor::new(&[f32::NAN, -1.0, 2.0], &Device::Cpu)?.reshape((1, 1, 3, 1))?;
    let one = Tensor::ones((1, 1), candle_core::DType::F32, &Device::Cpu)?;
    let y = convolution.forward(&x, &one, &one.flatten_all()?)?.flatten_all()?.to_vec1::<f32>()?;
    assert!(y[0].is_nan());
    assert_eq!(y[1..], [1.0, 3.0]);
    Ok(())
}

#[test]
fn refuses_shapes_that_do_not_fit() -> Result<()> {
    let zeros = |shape: &[usize]| Tensor::zeros(shape, candle_core::DType::F32, &Device::Cpu);
    let three = convolution(3, 1, 0, false);
    let cases = [
        (three, &[5, 5, 2][..], &[18, 4][..], &[4], "[5, 5, 2]"),
        (three, &[1, 5, 5, 2], &[17, 4], &[4], "[17, 4]"),
        (three, &[1, 5, 5, 2], &[18], &[4], "[18]"),
        (three, &[1, 5, 5, 2], &[18, 4], &[3], "[3]"),
        (three, &[1, 5, 2, 2], &[18, 4], &[4], "[1, 5, 2, 2]"),
        (convolution(3, 0, 0, false), &[1, 5, 5, 2], &[18, 4], &[4], "stride 0"),
        (convolution(0, 1, 0, false), &[1, 5, 5, 2], &[0, 4], &[4], "kernel 0"),
    ];
    for (convolution, x, weight, bias, named) in cases {
        let error = convolution.forward(&zeros(x)?, &zeros(weight)?, &zeros(bias)?).unwrap_err().to_string();
        assert!(error.contains(named), "{error:?} does not name {named}");
    }
    let double = |shape: &[usize]| Tensor::zeros(shape, candle_core::DType::F64, &Device::Cpu);
    assert!(three.forward(&double(&[1, 5, 5, 2])?, &double(&[18, 4])?, &double(&[4])?).is_err());
    Ok(())
}
