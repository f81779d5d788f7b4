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


@pytest.mark.parametrize(
    ("low", "high", "inside", "outside"),
    [
        (0, 360, "0 1 9 10 359 360 0.5 359.9999", "-1 -0.5 361 360.0001 1000 3600 -360"),
        (-360, 360, "-360 -359.5 -0.1 0 360", "-361 -360.1 360.1 -1000 400"),
        (5, 20, "5 5.1 9 10 19.9 20", "4 4.9 0 0.5 21 20.1 50 200 -5 -10"),
        (-20, -5, "-20 -19.9 -10 -5 -5.1", "-4 -4.9 -21 -20.1 0 5 10 -0.5 0.5"),
        (-5, 0, "-5 -0.1 0", "0.1 1 -5.1 -6 -10"),
        (0.25, 2.5, "0.25 0.26 0.3 1 2 2.5 2.49", "0 0.2 0.24 0.249 2.51 2.6 3 10 -1 25"),
        (-2.5, -0.25, "-2.5 -0.25 -1 -0.3", "-2.51 -3 -0.2 -0.24 0 1 -25"),
        (99, 101, "99 100 101 99.5", "98 98.9 101.5 102 9 10 999 1000"),
        (1000, 1000, "1000", "999 1001 1000.5 999.9 10000 100"),
    ],
)
def test_the_numbers_at_the_bounds_of_a_range(
    low: float, high: float, inside: str, outside: str
) -> None:
    for text in inside.split():
        assert in_range(low, high, text, whole=False), text
        assert in_range(low, high, text, whole=True) is ("." not in text), text
    for text in outside.split():
        assert not in_range(low, high, text, whole=False), text


def test_numbers_without_a_range_have_seven_digits_and_four_decimals() -> None:
    for text in ("0", "-1", "1234567", "-1234567.1234", "0.0001", "-0.5", "10.01"):
        assert matches(patterns.ANY_NUMBER, text), text
        assert matches(patterns.ANY_INTEGER, text) is ("." not in text), text
        assert matches(patterns.ANY_POSITION, f"[{text},{text}]"), text
    for text in ("12345678", "1.12345", "-0", "1.10", "01", "-01"):
        assert not matches(patterns.ANY_NUMBER, text), text
    assert matches(patterns.any_number(whole=True, digits=2), "99")
    assert not matches(patterns.any_number(whole=True, digits=2), "100")


def test_escaped_texts_match_themselves_alone() -> None:
    for text in ("a b_c", "1/2", "é\u0301", "(x)*[y]", "%", "日本"):
        python = re.sub(
            r"\\x\{(\w+)\}", lambda code: re.escape(chr(int(code[1], 16))), patterns.escaped(text)
        )
        assert matches(python, text) and not matches(python, text + "x")
    assert patterns.escaped("a.b") == r"a\x{2e}b"
