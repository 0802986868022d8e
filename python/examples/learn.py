"""Learns to go through a maze with stable-baselines3, and carries the bead in a running Ferry.

    python learn.py train FILE                  # a policy for the map colon
    python learn.py serve FILE [ADDRESS]        # http://127.0.0.1:8080 without an ADDRESS
    python learn.py export FILE ONNX            # for onnx_policy.py

The policy is given the places of goal and tool, and no image. So it learns one map by heart, and fails on others.
"""

import sys

import gymnasium
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.torch_layers import BaseFeaturesExtractor

import ferry
from ferry.sb3 import FerryVecEnv


class Waves(BaseFeaturesExtractor):
    def __init__(self, space: gymnasium.Space) -> None:
        super().__init__(space, 4 * (1 + 2 * 6))

    def forward(self, places: torch.Tensor) -> torch.Tensor:
        # Waves of 6 lengths tell neighboring cells apart.
        angles = (places[:, :, None] * torch.pi * 2.0 ** torch.arange(6)).flatten(1)
        return torch.cat([places, angles.sin(), angles.cos()], 1)


class Learned(ferry.Controller):
    def __init__(self, file: str) -> None:
        self.policy = PPO.load(file, device="cpu").policy

    def act(self, percept: ferry.Percept) -> ferry.Step:
        return percept.cell(int(self.policy.predict(percept.observation()["vector"], deterministic=True)[0]))


def train(file: str) -> None:
    lanes = gymnasium.make_vec("ferry/Lattice-v0", 256, map="colon", observation="vector", autoreset_mode="SameStep")
    network = {"features_extractor_class": Waves, "net_arch": [256, 256], "activation_fn": torch.nn.ReLU}
    settings = dict(n_steps=32, batch_size=2048, n_epochs=4, gamma=0.8, ent_coef=0.005, seed=1, verbose=1, device="cpu")
    learner = PPO("MlpPolicy", FerryVecEnv(lanes), lambda left: 1e-3 * left, policy_kwargs=network, **settings)
    learner.learn(1_500_000, log_interval=10).save(file)


def export(file: str, onnx: str) -> None:
    policy = PPO.load(file, device="cpu").policy
    actor = torch.nn.Sequential(policy.features_extractor, policy.mlp_extractor.policy_net, policy.action_net)
    torch.onnx.export(actor.eval(), (torch.zeros(1, 4),), onnx, input_names=["vector"], external_data=False)


if __name__ == "__main__":
    torch.set_num_threads(1)
    mode, file, *rest = sys.argv[1:]
    if mode == "serve":
        ferry.serve(Learned(file), *rest, name="learned")
    else:
        {"train": train, "export": export}[mode](file, *rest)
