from __future__ import annotations

import functools
import json
import random
import re
import string

import pytest

from planner_ft.decoding.constraints import patterns


def matches(pattern: str, text: str) -> bool:
    return re.fullmatch(pattern, text) is not None


def in_range(low: float, high: float, text: str, *, whole: bool) -> bool:
    pattern, beyond = patterns.number_range(low, high, whole=whole)
    return matches(pattern, text) and not any(matches(one, text) for one in beyond)


@pytest.mark.parametrize(
    ("low", "high"),
    [
        (0, 30),
        (0, 360),
        (-360, 360),
        (1, 360),
        (0, 604800),
        (0, 100),
        (-5, -2),
        (0.5, 2.25),
        (7, 7),
        (99, 1001),
        (-0.5, 0.5),
        (0.1, 0.9),
    ],
)
def test_a_range_takes_exactly_the_numbers_in_it(low: float, high: float) -> None:
    rng = random.Random(0)
    number, whole = (functools.partial(in_range, low, high, whole=kind) for kind in (False, True))
    span = high - low + 10
    values = [round(low - 5 + span * rng.random(), rng.randrange(5)) for _ in range(3000)] + [
        low,
        high,
        low - 1,
        high + 1,
        low - 0.0001,
        high + 0.0001,
    ]
    for value in values:
        value = int(value) if value == int(value) else value
        text = json.dumps(value)
        if "e" in text:
            continue
        assert number(text) == (low <= value <= high), text
        assert whole(text) == (low <= value <= high and value == int(value)), text


@pytest.mark.parametrize(
    "text",
    [
        "-0",
        "00",
        "01",
        "1.",
        ".5",
        "1.0",
        "2.50",
        "1e3",
        "+1",
        "NaN",
        "Infinity",
        "123456789",
        "0.00001",
        "",
        "-",
    ],
)
def test_numbers_are_written_in_one_way_and_are_bounded(text: str) -> None:
    assert not matches(patterns.ANY_NUMBER, text)
    assert not in_range(-1e7, 1e7, text, whole=False)


def test_strings_take_what_json_writes_and_nothing_else() -> None:
    pattern = patterns.string(40, blank=True).strip("/").replace(r"\/", "/")
    for text in (
        "",
        " a",
        'say "x"',
        "back\\slash",
        "\x00\x0b\x1f\n\r\t\b\f",
        "日本 🚤 é\u2028",
        "a/b",
        string.printable[:40],
    ):
        assert matches(pattern, json.dumps(text, ensure_ascii=False)), text
    for raw in (
        '"a\nb"',
        '"\\x"',
        '"\\u0041"',
        '"\\u001F"',
        '"\\ud800"',
        '"a',
        '"' + "a" * 41 + '"',
        '"\x7f"',
    ):
        assert not matches(pattern, raw), raw


def test_texts_of_parameters_are_not_blank() -> None:
    pattern = patterns.string(5, blank=False).strip("/").replace(r"\/", "/")
    assert matches(pattern, '"abc d"')
    assert matches(pattern, '"\\"a\\""')
    assert not any(matches(pattern, raw) for raw in ('""', '" "', '"\u3000a"', '"\\n"', '"abcdef"'))


def test_a_literal_is_read_back_by_the_grammar(embedded: object) -> None:
    from llguidance import LLMatcher
    from llguidance.hf import from_tokenizer

    engine = from_tokenizer(embedded)
    for text in (
        'a"b',
        "a\\b",
        "日本 🚤",
        "a\nb\tc",
        "a/b",
        "%if //x # y",
        "\x7f\u2028",
        "[^a]+(b|c)*.{2}$",
    ):
        for body in (patterns.literal(text), patterns.regex(patterns.escaped(text))):
            matcher = LLMatcher(engine, f'start: T "!"\nT: {body}')
            assert not matcher.is_error(), (body, matcher.get_error())
            ids = engine.tokenize_bytes((text + "!").encode())
            assert matcher.validate_tokens(ids) == len(ids)
            assert matcher.validate_tokens(engine.tokenize_bytes((text + "?").encode())) < len(ids)
