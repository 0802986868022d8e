"""Carries the bead in a running Ferry with a network from an ONNX file.

    python onnx_policy.py FILE [ADDRESS]        # http://127.0.0.1:8080 without an ADDRESS

The network is given `image`, `vector` or both: what the environments return with observation="dict". It may have them
as any type of number, and with further axes of length 1 or of any length. Its first output is one value for each of
the four actions; the largest is taken.
"""

import sys

import numpy as np
import onnxruntime

import ferry

TYPES = {
    "tensor(float)": np.float32,
    "tensor(double)": np.float64,
    "tensor(float16)": np.float16,
    "tensor(uint8)": np.uint8,
}


class Network(ferry.Controller):
    def __init__(self, file: str) -> None:
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = 1
        self.session = onnxruntime.InferenceSession(file, options, providers=["CPUExecutionProvider"])
        self.inputs = self.session.get_inputs()
        for place in self.inputs:
            if place.name not in ("image", "vector") or place.type not in TYPES:
                raise SystemExit(f"input {place.name} of type {place.type}: Ferry has only image and vector")

    def copy(self) -> ferry.Controller:
        # A session of onnxruntime cannot be copied, and nothing is kept between steps.
        return self

    def act(self, percept: ferry.Percept) -> ferry.Step:
        seen = percept.observation()
        given = {}
        for place in self.inputs:
            # The axis of the batch may have no fixed length.
            shape = [size if isinstance(size, int) else 1 for size in place.shape]
            given[place.name] = seen[place.name].astype(TYPES[place.type]).reshape(shape)
        values = self.session.run(None, given)[0].ravel()
        if len(values) != 4:
            raise ValueError(f"the network has {len(values)} values, it must have 4")
        return percept.cell(int(values.argmax()))


if __name__ == "__main__":
    ferry.serve(Network(sys.argv[1]), *sys.argv[2:], name="onnx")
