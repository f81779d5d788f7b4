"""The policies of SurveyTarget: the published network, and ours with conv over rays and memory."""

import math

import torch
from torch import Tensor, nn

from planner_ft.skills import geometry
from planner_ft.skills.dynamics import turned
from planner_ft.skills.survey import NUMBERS, Survey

WIDTH, DEPTH = 128, 3
SIGMA_MIN = 1e-3
SCANS = 8  # past scans that the memory keeps


def layers(inputs: int, outputs: int, activation: type[nn.Module] = nn.Tanh) -> nn.Sequential:
    """The published network: 3 layers of 128."""
    parts: list[nn.Module] = []
    for _layer in range(DEPTH):
        parts += [nn.Linear(inputs, WIDTH), activation()]
        inputs = WIDTH
    return nn.Sequential(*parts, nn.Linear(inputs, outputs))


class RayEncoder(nn.Module):
    """Convolutions round the circle of rays over the scan and the memory, then layers as published.

    Input (B, 68 + 64): the published observation, then the memory's ranges / 10 m.
    """

    def __init__(self, outputs: int) -> None:
        super().__init__()

        def over(channels: int, made: int) -> nn.Conv1d:
            return nn.Conv1d(channels, made, 5, 2, 2, padding_mode="circular")

        self.rays = nn.Sequential(over(2, 12), nn.ELU(), over(12, 12), nn.ELU(), nn.Flatten())
        self.rest = layers(12 * geometry.RAYS // 4 + NUMBERS - geometry.RAYS, outputs, nn.ELU)

    def forward(self, seen: Tensor) -> Tensor:
        rays, numbers, memory = torch.split(seen, [geometry.RAYS, 4, geometry.RAYS], -1)
        flat = torch.stack([1 - rays, 1 - memory], dim=-2).flatten(0, -3)
        encoded = self.rays(flat).reshape(*rays.shape[:-1], -1)
        made: Tensor = self.rest(torch.cat([encoded, numbers], dim=-1))
        return made


class Spread(nn.Module):
    """Location and spread (B, 2 each) of a TanhNormal from a network's four outputs."""

    def __init__(self, net: nn.Module, sigma: float = 1.0) -> None:
        super().__init__()
        self.net, self.bias = net, math.log(math.expm1(sigma))

    def forward(self, seen: Tensor) -> tuple[Tensor, Tensor]:
        location, spread = self.net(seen).chunk(2, dim=-1)
        return location, nn.functional.softplus(spread + self.bias) + SIGMA_MIN


class Memory:
    """The returns of the past scans of B vehicles, seen from where they are now.

    The vehicle's own reckoning of its motion carries them; each scan is one of an option's end.
    """

    def __init__(self, count: int) -> None:
        self.points = torch.full((count, SCANS, geometry.RAYS, 2), math.inf)
        self.at = torch.zeros(count, dtype=torch.long)

    def look(self, rows: Tensor, scan: Tensor, pose: Tensor, fresh: Tensor) -> Tensor:
        """Ranges (n, 64) by bearing of what vehicles `rows` (n,) saw before, 10 m where nothing
        was; then keep their `scan` (n, 64) from `pose` (n, 3). `fresh` (n,): forget what was.
        """
        self.points[rows[fresh]] = math.inf
        body = turned(self.points[rows] - pose[:, None, None, :2], -pose[:, 2, None, None])
        away = body.norm(dim=-1).nan_to_num(math.inf).flatten(1)
        angle = torch.atan2(body[..., 1], body[..., 0]).nan_to_num(0.0).flatten(1)
        ray = (angle * geometry.RAYS / (2 * math.pi)).round().long() % geometry.RAYS
        far = torch.full_like(scan, geometry.REACH)
        found = far.scatter_reduce(1, ray, away, "amin")
        angles = geometry.ray_angles() + pose[:, 2:3]
        ahead = torch.stack([angles.cos(), angles.sin()], dim=-1)
        ends = pose[:, None, :2] + scan[..., None] * ahead
        seen = (scan < geometry.REACH)[..., None]
        self.points[rows, self.at[rows]] = torch.where(seen, ends, math.inf)
        self.at[rows] = (self.at[rows] + 1) % SCANS
        return found


class Surveyor(nn.Module):
    """An actor (B, 2) for a `Survey`; `recipe` is "published" or "ours", which has a memory."""

    def __init__(self, recipe: str, sigma: float = 1.0) -> None:
        super().__init__()
        self.recipe = recipe
        net = layers(NUMBERS, 4) if recipe == "published" else RayEncoder(4)
        self.spread = Spread(net, sigma)
        self.memory: Memory | None = None

    def critic(self) -> nn.Module:
        """A new critic (B, 1) of the same kind."""
        return layers(NUMBERS, 1) if self.recipe == "published" else RayEncoder(1)

    def observe(self, survey: Survey) -> Tensor:
        """What the networks see, once for every option: (B, 68), or (B, 132) with the memory."""
        seen = survey.observe()
        if self.recipe == "published":
            return seen
        if self.memory is None or len(self.memory.points) != survey.count:
            self.memory = Memory(survey.count)
        rows = torch.arange(survey.count)
        before = self.memory.look(rows, survey.scan, survey.pose, survey.options == 0)
        return torch.cat([seen, before / geometry.REACH], dim=1)

    def forward(self, seen: Tensor) -> Tensor:
        """The action without chance (B, 2)."""
        return torch.tanh(self.spread(seen)[0])

    def act(self, survey: Survey) -> Tensor:
        """An actor of `episodes.play`."""
        return self(self.observe(survey))  # type: ignore[no-any-return]
