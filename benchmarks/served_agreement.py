"""Whether an exported model, served by llama.cpp, answers as it does here: the proof of `plannerft
export --gguf` and `bench --endpoint`.

    python benchmarks/served_agreement.py --server-python .venv-server/bin/python \
        --out build/served.json

Exports a candidate with its adapter merged, serves the GGUF file with llama-cpp-python's server,
compares the ids of a thousand prompts, benchmarks the server with `plannerft bench --endpoint`,
answers the same commands with the merged weights in float32 here, and prints where the two agree.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

SERVER = Path(__file__).with_name("llama_server.py")
PATIENCE = 600
"""Seconds for the server to load."""


def main() -> None:
    """Run the whole comparison."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--server-python",
        default=sys.executable,
        help="interpreter that has llama-cpp-python[server]",
    )
    parser.add_argument("--candidate", default="embedded")
    parser.add_argument(
        "--exported",
        type=Path,
        help="folder of an earlier export with --merge --gguf, instead of making one",
    )
    parser.add_argument("--level", default="mission", choices=("mission", "task"))
    parser.add_argument("--data", type=Path, default=Path("data/mission/test.jsonl"))
    parser.add_argument("--limit", type=int)
    parser.add_argument("--prompts", type=int, default=1000, help="prompts whose ids are compared")
    parser.add_argument("--schema", action="store_true", help="benchmark lora+schema, too")
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        result = compare(arguments, Path(temporary))
    print(json.dumps(result, indent=2))
    if arguments.out:
        arguments.out.parent.mkdir(parents=True, exist_ok=True)
        arguments.out.write_text(json.dumps(result, indent=2) + "\n")


def compare(arguments: argparse.Namespace, work: Path) -> dict[str, Any]:
    """Export, serve, ask and compare; files lie below `work`."""
    folder = arguments.exported or exported(arguments, work / "model")
    manifest = json.loads((folder / "manifest.json").read_text())
    with served(
        arguments.server_python, folder / manifest["gguf"]["file"], work / "server.log"
    ) as url:
        same_ids = compare_ids(url, folder, arguments.level, arguments.prompts)
        rows = benchmark(url, arguments, work / "served")
    here = local_answers(folder, arguments, work / "here.jsonl")
    theirs = {
        line["id"]: line
        for line in read_lines(work / "served" / "predictions.jsonl")
        if line["configuration"] == "lora"
    }
    different = [name for name, text in here.items() if theirs[name]["output"] != text]
    return {
        "manifest": manifest,
        "prompts_with_same_ids": f"{same_ids} of {arguments.prompts}",
        "same_answers": f"{len(here) - len(different)} of {len(here)}",
        "different": different,
        "f1_served": {row["configuration"]: row["metrics"]["f1"]["value"] for row in rows},
        "f1_here": score(work / "here.jsonl", arguments),
        "strictly_valid_served": {
            row["configuration"]: row["metrics"]["strict_valid"]["value"] for row in rows
        },
        "complete_but_invalid_served": complete_but_invalid(work / "served"),
        "latency_s_served": {
            row["configuration"]: row["metrics"]["latency_s"]["value"] for row in rows
        },
    }


def exported(arguments: argparse.Namespace, folder: Path) -> Path:
    """The folder of a fresh export."""
    from planner_ft.model_export import ExportSettings, export

    return export(
        ExportSettings(arguments.candidate, folder, arguments.level, merge=True, gguf=True), print
    ).folder


@contextlib.contextmanager
def served(python: str, gguf: Path, log: Path) -> Iterator[str]:
    """llama-cpp-python's server with this file, keys and values in float32; yields the root of its
    API.
    """
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    settings = {
        "host": "127.0.0.1",
        "port": port,
        "n_ctx": 4096,
        "n_threads": 1,
        "type_k": 0,
        "type_v": 0,
        "interrupt_requests": False,
    }
    flags = [text for name, value in settings.items() for text in (f"--{name}", str(value))]
    with open(log, "wb") as stream:
        server = subprocess.Popen(
            [python, str(SERVER), "--model", str(gguf), "--model_alias", "merged", *flags],
            stdout=stream,
            stderr=stream,
        )
    try:
        wait_for(f"http://127.0.0.1:{port}/v1/models", server, log)
        yield f"http://127.0.0.1:{port}/v1"
    finally:
        server.terminate()
        server.wait()


def wait_for(url: str, server: subprocess.Popen[bytes], log: Path) -> None:
    """Return when the server answers."""
    import httpx2

    until = time.monotonic() + PATIENCE
    while time.monotonic() < until and server.poll() is None:
        with contextlib.suppress(httpx2.HTTPError):
            if httpx2.get(url, timeout=5).status_code == 200:
                return
        time.sleep(0.5)
    raise SystemExit(f"the server did not start:\n{log.read_text(errors='replace')[-3000:]}")


def compare_ids(url: str, folder: Path, level: Any, count: int) -> int:
    """The number of drawn prompts that llama.cpp reads as the ids that we train on."""
    import httpx2

    from planner_ft.candidates import resolve_candidate
    from planner_ft.candidates.loading import load_tokenizer
    from planner_ft.model_export.check import check_records
    from planner_ft.prompts import render_prompt
    from planner_ft.vocabulary import load_vocabulary

    tokenizer, vocabulary = load_tokenizer(resolve_candidate(folder)), load_vocabulary("usv")
    if level == "task":
        records = check_records(level, vocabulary, count)
    else:
        from planner_ft.data.missions import sample_missions

        records = list(sample_missions(12345, count))
    same = 0
    with httpx2.Client(timeout=60) as client:
        for record in records:
            ids = render_prompt(level, record, tokenizer, vocabulary, with_vocabulary=False)
            text = tokenizer.decode(
                ids, skip_special_tokens=False, clean_up_tokenization_spaces=False
            )
            found = client.post(
                f"{url.removesuffix('/v1')}/extras/tokenize", json={"input": text}
            ).json()["tokens"]
            same += found == ids
    return same


def benchmark(url: str, arguments: argparse.Namespace, out: Path) -> list[dict[str, Any]]:
    """The rows of `plannerft bench --endpoint`."""
    configurations = "lora,lora+schema" if arguments.schema else "lora"
    flags = [
        "--endpoint",
        url,
        "--model",
        "merged",
        "--level",
        arguments.level,
        "--data",
        str(arguments.data),
        "--configurations",
        configurations,
    ]
    limit = ["--limit", str(arguments.limit)] if arguments.limit else []
    more = [
        "--latency-samples",
        "5",
        "--timeout",
        "600",
        "--concurrency",
        "2",
        "--out",
        str(out),
        *limit,
    ]
    subprocess.run([sys.executable, "-m", "planner_ft", "bench", *flags, *more], check=True)
    return list(json.loads((out / "results.json").read_text())["rows"])


def complete_but_invalid(run: Path) -> dict[str, list[str]]:
    """Answers by configuration that the model ended itself and that are not strictly valid: with
    +schema there should be none.
    """
    ended = {
        (line["configuration"], line["id"])
        for line in read_lines(run / "predictions.jsonl")
        if line["finish_reason"] == "stop"
    }
    found: dict[str, list[str]] = {configuration: [] for configuration, _name in sorted(ended)}
    for line in read_lines(run / "scores.jsonl"):
        if (line["configuration"], line["id"]) in ended and not line["strict_valid"]:
            found[line["configuration"]].append(line["id"])
    return found


def local_answers(folder: Path, arguments: argparse.Namespace, path: Path) -> dict[str, str]:
    """The texts of greedy answers in float32 by id, also written as predictions."""
    from planner_ft.candidates import resolve_candidate
    from planner_ft.candidates.loading import load_tokenizer
    from planner_ft.model_export.check import Answers, load_full
    from planner_ft.support.files import read_jsonl, write_jsonl
    from planner_ft.vocabulary import load_vocabulary

    vocabulary, candidate = load_vocabulary("usv"), resolve_candidate(folder)
    records, tokenizer = read_jsonl(arguments.data)[: arguments.limit], load_tokenizer(candidate)
    answers = Answers(arguments.level, records, tokenizer, vocabulary, with_vocabulary=False).of(
        load_full(candidate, None, arguments.level, vocabulary)
    )
    texts = {
        record["id"]: tokenizer.decode(list(ids), skip_special_tokens=True)
        for record, ids in zip(records, answers, strict=True)
    }
    write_jsonl(path, [{"id": name, "output": text} for name, text in texts.items()])
    return texts


def score(path: Path, arguments: argparse.Namespace) -> float | None:
    """Set F1 of a file of predictions."""
    from planner_ft.benchmark.samples import load_bench_data
    from planner_ft.benchmark.submission import score_predictions
    from planner_ft.vocabulary import load_vocabulary

    vocabulary = load_vocabulary("usv")
    results = score_predictions(
        path,
        load_bench_data(arguments.data, arguments.level, vocabulary, arguments.limit),
        vocabulary,
    )
    return results.rows[0].metrics["f1"].value


def read_lines(path: Path) -> list[dict[str, Any]]:
    """The objects of a JSON Lines file."""
    return [json.loads(line) for line in path.read_text().splitlines()]


if __name__ == "__main__":
    main()
