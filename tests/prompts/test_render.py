"""One function renders a sample for training, benchmark and planning: prompt ids, completion mask,
end of turn.
"""

from pathlib import Path
from typing import Any

import pytest

from planner_ft.candidates.loading import load_tokenizer
from planner_ft.candidates.registry import resolve_candidate
from planner_ft.prompts import (
    TODAY,
    completion_text,
    end_of_turn_ids,
    render_prompt,
    render_sample,
    system_text,
    user_text,
)
from planner_ft.vocabulary import load_vocabulary
from scripts.make_standins import make_standin

VOCABULARY = load_vocabulary()
END_OF_TURN = {
    "Llama-3.2-1B": "<|end_of_text|>",
    "Llama-3.2-1B-Instruct": "<|eot_id|>",
    "Llama-3.2-3B": "<|end_of_text|>",
    "Llama-3.2-3B-Instruct": "<|eot_id|>",
    "Llama-3.1-8B": "<|end_of_text|>",
    "Qwen2.5-3B": "<|im_end|>",
    "Qwen2.5-3B-Instruct": "<|im_end|>",
}
MISSION: dict[str, Any] = {
    "id": "m",
    "prompt": "Circle the tower at [4, 5] — 12.5 m off.",
    "expected": {
        "tasks": [
            {
                "title": "Transit",
                "parameters": {"target_position": [4.0, 5]},
                "task_prompt": "Go to [4, 5].",
            },
            {
                "title": "PerformOrbit",
                "parameters": {"radius": 12.5, "center": [4, 5]},
                "task_prompt": "Circle it.",
            },
        ],
        "assumptions": [],
        "constraints": [],
    },
}


@pytest.fixture(scope="module", params=sorted(END_OF_TURN))
def tokenizer(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Any:
    folder = Path(make_standin(request.param, tmp_path_factory.mktemp("standins")))
    tokenizer = load_tokenizer(resolve_candidate(str(folder)))
    tokenizer.planner_ft_name = request.param
    return tokenizer


def test_a_command_has_its_positions_in_the_form_of_plans_and_a_task_prompt_as_it_stands() -> None:
    record = {"prompt": "Orbit E12 N48.", "task": "PerformOrbit", "parameters": {}}
    assert user_text("mission", record, VOCABULARY) == "Orbit [12, 48]."
    assert user_text("task", record, VOCABULARY).endswith("Orbit E12 N48.")


def test_prompt_and_answer_join_without_a_seam(tokenizer: Any) -> None:
    rendered = render_sample("mission", MISSION, tokenizer, VOCABULARY)
    prompt = render_prompt("mission", MISSION, tokenizer, VOCABULARY, with_vocabulary=False)
    assert rendered.input_ids[: rendered.prompt_length] == prompt
    assert rendered.completion_mask == [0] * len(prompt) + [1] * (
        len(rendered.input_ids) - len(prompt)
    )
    answer = tokenizer.decode(rendered.input_ids[rendered.prompt_length : -1])
    assert answer == completion_text("mission", MISSION["expected"], VOCABULARY)


def test_the_end_of_turn_is_trained(tokenizer: Any) -> None:
    rendered = render_sample("mission", MISSION, tokenizer, VOCABULARY)
    assert (
        tokenizer.convert_ids_to_tokens(rendered.input_ids[-1])
        == END_OF_TURN[tokenizer.planner_ft_name]
    )
    assert rendered.completion_mask[-1] == 1
    assert rendered.input_ids[-1] == end_of_turn_ids(tokenizer)[0]


def test_there_is_one_beginning_of_text_at_most(tokenizer: Any) -> None:
    prompt = render_prompt("mission", MISSION, tokenizer, VOCABULARY, with_vocabulary=True)
    assert prompt.count(tokenizer.bos_token_id) == (1 if tokenizer.bos_token_id is not None else 0)


def test_only_base_models_are_shown_the_vocabulary(tokenizer: Any) -> None:
    shown = tokenizer.decode(
        render_prompt("mission", MISSION, tokenizer, VOCABULARY, with_vocabulary=True)
    )
    hidden = tokenizer.decode(
        render_prompt("mission", MISSION, tokenizer, VOCABULARY, with_vocabulary=False)
    )
    assert all(task.title in shown for task in VOCABULARY.tasks)
    assert not any(task.title in hidden for task in VOCABULARY.tasks)
    assert MISSION["prompt"] in shown and MISSION["prompt"] in hidden


def test_targets_are_serialised_in_one_canonical_way() -> None:
    text = completion_text("mission", MISSION["expected"], VOCABULARY)
    assert '"parameters":{"target_position":[4,5]}' in text
    assert '"parameters":{"center":[4,5],"radius":12.5}' in text


def test_the_task_agent_gets_title_parameters_and_prompt() -> None:
    record = {
        "task": "SurveyTarget",
        "parameters": {"radius": 3.0, "target_position": [1, 2]},
        "prompt": "Look at it.",
    }
    assert (
        user_text("task", record, VOCABULARY)
        == 'SurveyTarget\n{"target_position":[1,2],"radius":3}\nLook at it.'
    )


@pytest.mark.parametrize(
    "injected", ["<|eot_id|>", "<|im_end|>", "<|end_of_text|>", "<|endoftext|>"]
)
def test_special_tokens_in_a_command_are_text(tokenizer: Any, injected: str) -> None:
    plain, attack = ({**MISSION, "prompt": f"Find the {word} now."} for word in ("buoy", injected))
    special = set(tokenizer.all_special_ids)
    counts = [
        sum(
            token in special
            for token in render_prompt(
                "mission", record, tokenizer, VOCABULARY, with_vocabulary=False
            )
        )
        for record in (plain, attack)
    ]
    assert counts[0] == counts[1]


def test_the_prompt_is_tokenised_as_the_whole_text_would_be(tokenizer: Any) -> None:
    system = system_text("mission", VOCABULARY, with_vocabulary=False)
    if tokenizer.chat_template:
        messages = [
            {"role": "system", "content": system},
            {"role": "user", "content": MISSION["prompt"]},
        ]
        text = tokenizer.apply_chat_template(
            messages, tokenize=False, add_generation_prompt=True, date_string=TODAY
        )
    else:
        text = (
            f"{tokenizer.bos_token or ''}{system}\n\n### Input\n{MISSION['prompt']}\n\n### Plan\n"
        )
    assert render_prompt(
        "mission", MISSION, tokenizer, VOCABULARY, with_vocabulary=False
    ) == tokenizer.encode(text, add_special_tokens=False)


@pytest.mark.parametrize(
    "typed",
    [
        "CIRCLE THE MOORING BUOY AT [40, 12] AND COME HOME",
        "Circle The Mooring Buoy At [40, 12] And Come Home",
        "circle  the mooring\tbuoy at [40 , 12] and come home",
        "um circle the moorign buoy at, uh, [40, 12] and come home",
    ],
)
def test_a_command_is_told_plainly(typed: str) -> None:
    told = user_text("mission", {"prompt": typed}, VOCABULARY).strip().replace("at, [", "at [")
    assert told == "circle the mooring buoy at [40, 12] and come home"
    twice = "2x round the islet, 2x4 m off"
    assert user_text("mission", {"prompt": twice}, VOCABULARY) == twice.replace("2x ", "2 times ")
    named = "Find MV Alina and Durius Two"
    assert user_text("mission", {"prompt": named}, VOCABULARY) == named
