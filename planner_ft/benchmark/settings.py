"""Settings of a run."""

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlsplit

from planner_ft.candidates.registry import Quantization
from planner_ft.decoding.configurations import MAX_NEW_TOKENS
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.plans import Level

LONGEST = 16384
CHAT = "/chat/completions"
ROOT = "give the API's root, such as http://127.0.0.1:8000/v1"


def out_of_range(**bounds: tuple[float, float, float]) -> list[str]:
    """Problems of settings by flag: (value, lowest, highest)."""
    return [
        f"--{flag.replace('_', '-')} {value}: must be between {low} and {high}"
        for flag, (value, low, high) in bounds.items()
        if not low <= value <= high
    ]


@dataclass(frozen=True)
class EndpointSettings:
    """A server that speaks the OpenAI chat completions API, and how it is asked.

    `url` is the API's root ("http://127.0.0.1:8000/v1"), `model` the name that the server knows.
    `api_key_env` names the environment variable that holds the key; the key itself stands nowhere.
    At most `concurrency` questions are open at a time, each for at most `timeout` seconds, and
    asked again up to `retries` times. Raises PlannerError that lists every problem.
    """

    url: str
    model: str
    api_key_env: str | None = None
    concurrency: int = 4
    timeout: float = 60.0
    retries: int = 5

    def __post_init__(self) -> None:
        named = self.model.strip()
        problems = [] if named else ["--model: give the name by which the server knows the model"]
        problems += _url_problems(self.url)
        problems += out_of_range(
            concurrency=(self.concurrency, 1, 256),
            timeout=(self.timeout, 0.1, 86400),
            retries=(self.retries, 0, 100),
        )
        if problems:
            raise PlannerError("; ".join(problems))

    @property
    def root(self) -> str:
        """The URL that paths such as /chat/completions are appended to."""
        return self.url.strip().rstrip("/").removesuffix(CHAT).rstrip("/")

    @property
    def host(self) -> str:
        """Host and port, as tables name the server."""
        return urlsplit(self.root).netloc

    def api_key(self) -> str | None:
        """The key, if one is used. Raises PlannerError: no such variable, or no header text."""
        if self.api_key_env is None:
            return None
        key = os.environ.get(self.api_key_env, "").strip()
        if key and key.isascii() and key.isprintable():
            return key
        wrong, unset = "holds characters that no key has", "this environment variable is not set"
        problem = f"{wrong if key else unset}; export the server's key in it"
        raise PlannerError(f"--api-key-env {self.api_key_env}: {problem}")


def _url_problems(url: str) -> list[str]:
    """Problems of a URL. It is not repeated where it may hold a password."""
    try:
        parts = urlsplit(url.strip())
        port_is_number = parts.port is None or parts.port > 0
    except ValueError:
        return [f"--endpoint: no URL; {ROOT}"]
    if parts.username or parts.password or parts.query or parts.fragment:
        why = "it is written into manifests"
        alone = f"give the URL without user, password or query ({why})"
        return [f"--endpoint: {alone}, and a key with --api-key-env"]
    if parts.scheme not in ("http", "https") or not parts.hostname or not port_is_number:
        return [f"--endpoint {url}: no http URL; {ROOT}"]
    return []


@dataclass(frozen=True)
class BenchSettings:
    """A run. `None` stands for the default that depends on level or candidate.

    `candidates` are names, folders or hub ids, `configurations` as `parse_configuration` reads
    them, `adapters` folders ("DIR", or "NAME=DIR" per candidate). A `batch_size` of None finds
    itself. `latency_samples` are the samples whose queries are timed one at a time,
    `planning_samples` the missions of each length that both agents are timed on. With `endpoint` a
    server answers, and the only candidate is its model. With a `temperature` above 0 every sample
    is asked `repeats` times. Raises PlannerError that lists every problem.
    """

    level: Level
    candidates: tuple[str, ...]
    configurations: tuple[str, ...] = ("base", "lora")
    data: Path | None = None
    out: Path | None = None
    limit: int | None = None
    adapters: tuple[str, ...] = ()
    vocabulary: str = "usv"
    device: str = "auto"
    quantization: Quantization | None = None
    batch_size: int | None = None
    max_new_tokens: int | None = None
    latency_samples: int = 50
    planning_samples: int = 0
    seed: int = 0
    resume: bool = False
    overwrite: bool = False
    repeats: int = 1
    temperature: float = 0.0
    top_p: float = 1.0
    endpoint: EndpointSettings | None = None

    def __post_init__(self) -> None:
        problems = out_of_range(
            batch_size=(1 if self.batch_size is None else self.batch_size, 1, 1024),
            max_new_tokens=(self.token_limit, 1, LONGEST),
            latency_samples=(self.latency_samples, 0, 10**9),
            planning_samples=(self.planning_samples, 0, 1000),
            repeats=(self.repeats, 1, 1000),
        )
        if problems := [*problems, *self._problems()]:
            raise PlannerError("; ".join(problems))

    def _problems(self) -> Iterator[str]:
        """Sentences about what is out of range or does not go together."""
        greedy, again = self.temperature == 0, "give --temperature, for example 0.7"
        if not self.candidates:
            yield "--candidates: name at least one; `plannerft candidates` lists them"
        if not self.configurations:
            yield "--configurations: name at least one"
        if self.quantization not in (None, "nf4", "none"):
            yield f"--quantization {self.quantization}: must be nf4 or none"
        if not 0 <= self.temperature <= 10:
            yield f"--temperature {self.temperature:g}: must be between 0 (greedy) and 10"
        if not 0 < self.top_p <= 1:
            yield f"--top-p {self.top_p:g}: must be above 0 and at most 1"
        if greedy and self.repeats > 1:
            yield f"--repeats {self.repeats}: greedy answers are all the same; {again}"
        if greedy and self.top_p != 1:
            yield f"--top-p {self.top_p:g}: greedy decoding samples nothing; {again}"
        if self.resume and self.overwrite:
            yield "--resume keeps former results and --overwrite removes them: give one of them"
        if self.planning_samples and not (self.level == "mission" and not self.endpoint and greedy):
            agents = "times both agents from the mission level on, here and greedily"
            yield f"--planning-samples {agents}: leave it out"
        loaded = {
            "--adapter": self.adapters,
            "--quantization": self.quantization,
            "--device": self.device != "auto",
        }
        if self.endpoint and (flags := [flag for flag, given in loaded.items() if given]):
            here = "these go with models that are loaded here"
            yield f"{', '.join(flags)}: {here}; leave them out when you give --endpoint"

    @property
    def token_limit(self) -> int:
        """The limit of generated tokens per answer."""
        return MAX_NEW_TOKENS[self.level] if self.max_new_tokens is None else self.max_new_tokens

    @property
    def folder(self) -> Path:
        """The output folder."""
        return self.out or Path("eval/runs") / self.level
