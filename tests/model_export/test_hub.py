"""`plannerft push`: what is uploaded, the cards, and an upload to a server that answers as the Hub."""

from __future__ import annotations

import base64
import json
import shutil
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any

import huggingface_hub
import pytest
import yaml
from typer.testing import CliRunner

from planner_ft.candidates.registry import all_candidates, model_metadata
from planner_ft.cli.app import app
from planner_ft.model_export.hub import prepare, upload
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json

ROOT = Path(__file__).parents[2]
ADAPTER, DATA = ROOT / "adapters/embedded/mission", ROOT / "data/mission"


@pytest.fixture
def adapter(tmp_path: Path) -> Path:
    """A copy of a shipped adapter beside files of others."""
    folder = shutil.copytree(ADAPTER, tmp_path / "adapter")
    (folder / "notes.txt").write_text("not for the Hub")
    (folder / "checkpoints").mkdir()
    (folder / "checkpoints" / "run.json").write_text("{}")
    return folder


@pytest.fixture
def changed(adapter: Path) -> Callable[..., Path]:
    """The adapter with other values in its manifest."""

    def change(**values: Any) -> Path:
        write_json(adapter / "manifest.json", read_json(adapter / "manifest.json") | values)
        return adapter

    return change


def test_a_dry_run_lists_the_adapters_own_files_without_token_or_network(adapter: Path) -> None:
    result = CliRunner().invoke(
        app, ["push", str(adapter), "--repo", "org/planner", "--dry-run"], catch_exceptions=False
    )
    assert result.exit_code == 0
    listed = [line.split()[-1] for line in result.stdout.splitlines()[:-1]]
    assert {"README.md", "adapter_model.safetensors", "manifest.json", "tokenizer.json"} < set(
        listed
    )
    assert "confidence-mission-lora+grounded.json" in listed
    assert "notes.txt" not in listed and "run.json" not in listed
    assert result.stdout.splitlines()[-1] == (
        f"{len(listed)} files for https://huggingface.co/org/planner (model); nothing was sent"
    )
    size = (adapter / "adapter_model.safetensors").stat().st_size
    assert f"{size:,} bytes  adapter_model.safetensors" in result.stdout
    assert "comes with planner_ft" in result.stderr


def test_a_data_set_uploads_what_gen_data_wrote() -> None:
    prepared = prepare(DATA, "org/missions")
    assert prepared.kind == "dataset"
    written = {"README.md", "leakage.json", "manifest.json"}
    assert set(prepared.files) == {"train.jsonl", "validation.jsonl", "test.jsonl"} | written


def test_the_cards_have_the_metadata_of_the_hub(adapter: Path) -> None:
    model = huggingface_hub.ModelCard(prepare(adapter, "org/planner", "org/missions").card)
    assert model.data.datasets == ["org/missions"]
    assert (model.data.library_name, model.data.license) == ("peft", "apache-2.0")
    assert model.data.pipeline_tag == "text-generation"
    data = huggingface_hub.DatasetCard(prepare(DATA, "org/missions").card)
    assert data.data.task_categories == ["text-generation"]
    assert (data.data.language, data.data.license) == (["en"], "apache-2.0")


@pytest.mark.parametrize("candidate", [one for one in all_candidates() if one.repo])
def test_a_published_bases_card_names_base_and_licence(candidate: Any) -> None:
    manifest = {"licence": candidate.licence, "base": {"repo": candidate.repo}}
    values = yaml.safe_load(model_metadata(manifest | {"vocabulary": {"name": "usv"}}, "peft"))
    assert values["base_model"] == candidate.repo
    assert values["tags"] == ["lora", "qlora", "mission-planning", "usv", "planner_ft"]
    assert (values["library_name"], values["language"]) == ("peft", "en")
    named = {"Llama-3.2": "llama3.2", "Llama-3.1": "llama3.1", "Qwen2.5-3": "other"}
    assert values["license"] == named[candidate.name[:9]]
    assert ("license_name" in values) == candidate.name.startswith("Qwen")


def test_a_stand_ins_adapter_is_refused(changed: Callable[..., Path]) -> None:
    with pytest.raises(PlannerError, match="stand-in with random weights"):
        prepare(changed(is_standin=True), "org/planner")


def test_the_licence_and_the_data_of_a_llama_are_noted(changed: Callable[..., Path]) -> None:
    base = {"name": "Llama-3.2-1B", "repo": "meta-llama/Llama-3.2-1B"}
    folder = changed(base=base, licence="Llama 3.2 Community License")
    notes = prepare(folder, "org/planner").notes
    assert [("begins with Llama" in note, "--dataset" in note) for note in notes] == [
        (True, False),
        (False, True),
    ]
    assert prepare(folder, "org/Llama-planner", "org/data").notes == ()


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda folder: (folder / "adapter_model.safetensors").write_bytes(b"x"), "differs from"),
        (lambda folder: (folder / "README.md").unlink(), "README.md: is missing"),
        (lambda folder: (folder / "README.md").write_text("# A card\n"), "lacks library_name"),
        (lambda folder: (folder / "README.md").write_text("---\na: [\n---\n"), "cannot be read"),
        (lambda folder: (folder / "manifest.json").unlink(), "not written by train or gen-data"),
    ],
)
def test_a_folder_that_is_not_as_it_was_written_is_refused(
    adapter: Path, spoil: Callable[[Path], Any], message: str
) -> None:
    spoil(adapter)
    with pytest.raises(PlannerError, match=message):
        prepare(adapter, "org/planner")


@pytest.mark.parametrize(
    ("repo", "dataset", "message"),
    [("a/b/c", None, "no name of a repository"), ("a/b", "a b/c", "no name of a repository")],
)
def test_names_are_checked(repo: str, dataset: str | None, message: str) -> None:
    with pytest.raises(PlannerError, match=message):
        prepare(ADAPTER, repo, dataset)


def test_without_a_token_the_way_to_one_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(huggingface_hub, "get_token", lambda: None)
    result = CliRunner().invoke(app, ["push", str(DATA), "--repo", "org/missions"])
    assert isinstance(result.exception, PlannerError)
    assert "hf auth login" in str(result.exception)


class Hub(BaseHTTPRequestHandler):
    """The requests of an upload, answered as the Hub does; `commits` keeps what arrived."""

    commits: list[dict[str, Any]]
    refusal: str | None

    def do_POST(self) -> None:
        body = self.rfile.read(int(self.headers["Content-Length"]))
        assert self.headers["Authorization"] == "Bearer hf_test"
        if self.refusal:
            self.answer({"error": self.refusal}, 403)
        elif self.path == "/api/repos/create":
            made = json.loads(body)
            page = f"datasets/{made['organization']}/{made['name']}"
            self.answer({"url": f"{self.server.url}/{page}"})  # type: ignore[attr-defined]
        elif self.path == "/api/validate-yaml":
            self.answer({"errors": [], "warnings": []})
        elif "/preupload/" in self.path:
            names = [one["path"] for one in json.loads(body)["files"]]
            modes = [{"path": n, "uploadMode": "regular", "shouldIgnore": False} for n in names]
            self.answer({"files": modes})
        else:
            lines = [json.loads(line)["value"] for line in body.splitlines()]
            files = {one["path"]: base64.b64decode(one["content"]) for one in lines[1:]}
            self.commits.append({"path": self.path, "summary": lines[0]["summary"], "files": files})
            url = f"{self.server.url}/org/missions/commit/abc"  # type: ignore[attr-defined]
            self.answer({"commitUrl": url, "commitOid": "abc", "success": True})

    def answer(self, values: dict[str, Any], status: int = 200) -> None:
        content = json.dumps(values).encode()
        self.send_response(status)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, *_arguments: Any) -> None:
        pass


@pytest.fixture
def hub(monkeypatch: pytest.MonkeyPatch) -> Iterator[type[Hub]]:
    Hub.commits, Hub.refusal = [], None
    server = ThreadingHTTPServer(("127.0.0.1", 0), Hub)
    server.url = f"http://127.0.0.1:{server.server_port}"  # type: ignore[attr-defined]
    thread = Thread(target=server.serve_forever, daemon=True)
    thread.start()
    monkeypatch.setattr("huggingface_hub.constants.HF_HUB_OFFLINE", False)
    monkeypatch.setattr("huggingface_hub.constants.ENDPOINT", server.url)  # type: ignore[attr-defined]
    monkeypatch.setattr(huggingface_hub, "get_token", lambda: "hf_test")
    yield Hub
    server.shutdown()
    server.server_close()


def test_all_files_arrive_in_one_commit(hub: type[Hub]) -> None:
    prepared = prepare(DATA, "org/missions")
    assert upload(prepared, private=False).endswith("/org/missions/commit/abc")
    (commit,) = hub.commits
    assert commit["path"].startswith("/api/datasets/org/missions/commit/main")
    assert commit["files"] == {name: (DATA / name).read_bytes() for name in prepared.files}


def test_a_refusal_is_the_hubs_own_words(hub: type[Hub]) -> None:
    hub.refusal = "You don't have the rights to create a dataset under the namespace org"
    with pytest.raises(PlannerError, match=r"org/missions: the Hub refuses .*rights to create"):
        upload(prepare(DATA, "org/missions"), private=False)
    assert hub.commits == []


def test_a_hub_that_is_away_is_one_sentence(
    hub: type[Hub], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("huggingface_hub.constants.ENDPOINT", "http://127.0.0.1:9")
    with pytest.raises(PlannerError, match=r"the upload failed .*Connection refused"):
        upload(prepare(DATA, "org/missions"), private=False)
