"""The one place that turns a sample into texts and token ids, for training, benchmark and planning
alike: system instruction, user message and answer, then ids and completion mask together.

Prompt and completion are tokenised apart and joined, so that the ids a model was trained on are
exactly the ids that it is given when it generates. Chat candidates use their tokenizer's chat
template, base models a plain form that ends with their end-of-text token.
"""

from __future__ import annotations

import json
import re
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.data.task.working import working_of
from planner_ft.facts.places import with_brackets
from planner_ft.facts.spelling import fluent, spelt
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, read_text, write_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import WORKING, Level, canonical_parameters, canonical_plan
from planner_ft.vocabulary.schema import prompt_text

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerBase as Tokenizer

_FILE = Path(__file__).with_name("instructions.toml")
INSTRUCTIONS: dict[str, dict[str, str]] = tomllib.loads(read_text(_FILE))
Record = dict[str, Any]
"""A sample: its prompt, the task and parameters of a task, the `expected` plan."""
PLAIN_FORM = "{system}\n\n### Input\n{user}\n\n### Plan\n"
"""The prompt of a model without a chat template."""
PROMPT_VERSION = 5
"""Counts up with every change of the rendered text: predictions are not reused across it."""
FEWEST, SHOUTED = 4, 0.8
"""Words of a text that is typed in capitals, and the part of them that begin with one."""
_WORD, _BLANKS = re.compile(r"[^\W\d_]{3,}"), re.compile(r"[^\S\n]+")
_TIMES = re.compile(r"(?<![\w.,])([2-9])x(?= [A-Za-z])")  # "2x round"
PROBE = "\x02probe\x03"
TODAY = "26 Jul 2024"
"""The date in the system message of Llama 3 templates, which would write today's."""


def system_text(level: Level, vocabulary: Vocabulary, *, with_vocabulary: bool) -> str:
    """The instruction of an agent, for base models with the answer's form and the vocabulary."""
    instruction = INSTRUCTIONS[level]["instruction"].format(vehicle=vocabulary.title)
    if not with_vocabulary:
        return instruction
    places = {"home": list(vocabulary.home), "unresolved": list(vocabulary.unresolved)}
    values = {"frame": vocabulary.frame, "vocabulary": prompt_text(level, vocabulary), **places}
    form = INSTRUCTIONS[level]["form"].format(**values)
    return f"{instruction}\n{form}"


def user_text(level: Level, record: Record, vocabulary: Vocabulary) -> str:
    """The agent's input: the command with its positions in the form of plans ("x=4, y=9" as
    "[4, 9]"), or a task's title, parameters and prompt on three lines.
    """
    prompt = _plainly(str(record["prompt"]))
    if level == "mission":
        return with_brackets(prompt)
    task = vocabulary.task.get(record["task"])
    parameters = canonical_parameters(record.get("parameters", {}), task)
    return f"{record['task']}\n{compact_json(parameters)}\n{prompt}"


def _plainly(text: str) -> str:
    """The text with single blanks, none before a comma, "2x" as "2 times"; without capitals where
    most of its words begin with one, and without slips.
    """
    text = _TIMES.sub(r"\1 times", _BLANKS.sub(" ", fluent(text)).replace(" ,", ","))
    words = _WORD.findall(text)
    capitals = sum(word[0].isupper() for word in words)
    loud = len(words) >= FEWEST and capitals > SHOUTED * len(words)
    return spelt(text.lower() if loud else text)


def completion_text(level: Level, plan: dict[str, Any], vocabulary: Vocabulary) -> str:
    """The canonical plan as compact JSON."""
    return compact_json(canonical_plan(level, plan, vocabulary))


def answer_text(level: Level, record: Record, vocabulary: Vocabulary) -> str:
    """The answer that is trained: the sums that its waypoints need, and the `expected` plan."""
    text = completion_text(level, record["expected"], vocabulary)
    working = working_of(record, vocabulary) if level == "task" else ""
    return f"{{{compact_json(WORKING)}:{compact_json(working)},{text[1:]}" if working else text


def prompt_messages(
    level: Level, record: Record, vocabulary: Vocabulary, *, with_vocabulary: bool
) -> list[dict[str, str]]:
    """System instruction and user message: the text that `render_prompt` renders into ids."""
    system = system_text(level, vocabulary, with_vocabulary=with_vocabulary)
    user = user_text(level, record, vocabulary).strip()
    return [{"role": "system", "content": system}, {"role": "user", "content": user}]


def chat_messages(level: Level, record: Record, vocabulary: Vocabulary) -> list[dict[str, str]]:
    """The prompt's messages and the expected plan as the assistant's answer, for other trainers."""
    prompt = prompt_messages(level, record, vocabulary, with_vocabulary=False)
    return [*prompt, {"role": "assistant", "content": answer_text(level, record, vocabulary)}]


# ---------------------------------------------------------------- token ids


@dataclass(frozen=True)
class Rendered:
    """One sample as token ids.

    `input_ids` and `completion_mask` have the same length; the mask is 1 on the answer and its
    end-of-turn token, 0 on the prompt. `prompt_length` is the number of leading prompt ids.
    """

    input_ids: list[int]
    completion_mask: list[int]
    prompt_length: int


def render_prompt(
    level: Level,
    record: Record,
    tokenizer: Tokenizer,
    vocabulary: Vocabulary,
    *,
    with_vocabulary: bool,
) -> list[int]:
    """Ids of the prompt, up to the answer. `with_vocabulary`: for models that lack it."""
    before, after = prompt_frame(level, tokenizer, vocabulary, with_vocabulary=with_vocabulary)
    user = user_text(level, record, vocabulary)
    # The template or _bos already wrote the beginning-of-text token: special tokens must not be
    # added again. What the operator wrote is text: "<|eot_id|>" in a command is spelt out and ends
    # nothing.
    return [
        *tokenizer.encode(before, add_special_tokens=False),
        *tokenizer.encode(user.strip(), add_special_tokens=False, split_special_tokens=True),
        *tokenizer.encode(after, add_special_tokens=False),
    ]


def prompt_frame(
    level: Level, tokenizer: Tokenizer, vocabulary: Vocabulary, *, with_vocabulary: bool = False
) -> tuple[str, str]:
    """The text of a prompt before and behind the agent's input, special tokens included."""
    system = system_text(level, vocabulary, with_vocabulary=with_vocabulary)
    if tokenizer.chat_template:
        messages = [{"role": "system", "content": system}, {"role": "user", "content": PROBE}]
        options = {"tokenize": False, "add_generation_prompt": True, "date_string": TODAY}
        text = str(tokenizer.apply_chat_template(messages, **options))
    else:
        text = _bos(tokenizer) + PLAIN_FORM.format(system=system, user=PROBE)
    before, after = text.split(PROBE)
    return before, after


def with_fixed_date(template: Any) -> Any:
    """A chat template that writes TODAY where it would write today's date (Llama 3)."""
    if not isinstance(template, str) or "date_string" not in template:
        return template
    setting = f'{{%- set date_string = "{TODAY}" %}}'
    fixed = f"{{%- if not date_string is defined %}}{setting}{{%- endif %}}"
    return template if template.startswith(fixed) else fixed + template


def save_tokenizer(tokenizer: Any, model: Any, folder: Path) -> None:
    """Write tokenizer, chat template and generation settings that give the prompt and the end of
    training: a fixed date in the template, the trained end of turn before the model's own ends.
    """
    template = tokenizer.chat_template
    tokenizer.chat_template = with_fixed_date(template)
    tokenizer.save_pretrained(folder)
    tokenizer.chat_template = template
    settings = json.loads(model.generation_config.to_json_string())
    ends = ends_of_answers(tokenizer, model.generation_config.eos_token_id)
    write_json(folder / "generation_config.json", {**settings, "eos_token_id": ends})


def render_sample(
    level: Level,
    record: Record,
    tokenizer: Tokenizer,
    vocabulary: Vocabulary,
    *,
    with_vocabulary: bool = False,
) -> Rendered:
    """Ids and completion mask of a record with its `expected` plan."""
    prompt = render_prompt(level, record, tokenizer, vocabulary, with_vocabulary=with_vocabulary)
    answer = tokenizer.encode(answer_text(level, record, vocabulary), add_special_tokens=False)
    completion = [*answer, end_of_turn_ids(tokenizer)[0]]
    return Rendered(prompt + completion, [0] * len(prompt) + [1] * len(completion), len(prompt))


def ends_of_answers(tokenizer: Tokenizer, named: Any = None) -> list[int]:
    """Ids that end an answer: those of the tokenizer, then those of generation settings."""
    more = [named] if isinstance(named, int) else list(named or [])
    return list(dict.fromkeys([*end_of_turn_ids(tokenizer), *more]))


def end_of_turn_ids(tokenizer: Tokenizer) -> list[int]:
    """Ids that end an answer: the trained one, then the end-of-text token where it is another.

    A chat template's is the first token that it writes after the assistant's message. Raises
    PlannerError when that is no special token: a model could then never learn to stop.
    """
    eos = tokenizer.eos_token_id
    if not tokenizer.chat_template:
        if not isinstance(eos, int):
            way = "set eos_token in its tokenizer_config.json"
            raise PlannerError(f"the tokenizer has no end-of-text token; {way}")
        return [eos]
    messages = [{"role": "user", "content": "?"}, {"role": "assistant", "content": PROBE}]
    after = str(tokenizer.apply_chat_template(messages, tokenize=False)).split(PROBE)[-1]
    ids = tokenizer.encode(after, add_special_tokens=False)
    special = {*tokenizer.all_special_ids, *tokenizer.added_tokens_decoder}
    if not ids or ids[0] not in special:
        why = "which is no special token; the end of a plan cannot be learned"
        raise PlannerError(f"the chat template ends an answer with {after!r}, {why}")
    return list(dict.fromkeys([ids[0], *([eos] if isinstance(eos, int) else [])]))


def _bos(tokenizer: Tokenizer) -> str:
    """The beginning-of-text token where the tokenizer itself would write one, else nothing."""
    bos = tokenizer.bos_token
    begins = tokenizer.encode("x", add_special_tokens=True)[:1] == [tokenizer.bos_token_id]
    return str(bos) if bos and begins else ""
