"""The grammar of templates and the text that is made of chosen parts."""

import random

import pytest

from planner_ft.data.templates.grammar import (
    Choice,
    Slot,
    TemplateError,
    all_slots,
    choose,
    parse_plan,
    parse_text,
)
from planner_ft.data.templates.render import (
    VALUE_CLOSE,
    VALUE_OPEN,
    article_for,
    joined,
    plain,
    skeleton,
)


def test_alternatives_nest_and_marks_can_be_escaped():
    nodes = parse_text(r"(Go|Sail (out|home)) \(now\) (by day) \[x\] {T1:boat a}|"[:-1])
    assert isinstance(nodes[0], Choice) and len(nodes[0].branches) == 2
    texts = {
        "".join(part for part in choose(nodes, random.Random(seed), []) if isinstance(part, str))
        for seed in range(40)
    }
    assert texts == {f"{way} (now) (by day) [x] " for way in ("Go", "Sail out", "Sail home")}
    assert list(all_slots(nodes)) == [Slot("T1", "T", "", "boat", frozenset({"a"}))]


def test_slots_have_signs():
    slots = list(all_slots(parse_text("{~P1} {_name} {?film} {param.time} {time2 adj}")))
    assert [(slot.sign, slot.key, slot.base) for slot in slots] == [
        ("~", "P1", "P"),
        ("_", "name", "name"),
        ("?", "film", "film"),
        ("param", "time", "time"),
        ("", "time2", "time"),
    ]


def test_an_optional_part_stands_when_its_slots_are_given():
    nodes = parse_text("Hold[ for {time}]")
    assert choose(nodes, random.Random(0), []) == ["Hold"]
    assert len(choose(nodes, random.Random(0), [], frozenset({"time"}))) == 3


@pytest.mark.parametrize("text", ["(a|b", "a|b", "a)", "{x", "[no slot]", "{a-b}", "x]"])
def test_texts_that_do_not_parse(text):
    with pytest.raises(TemplateError):
        parse_text(text)


def test_a_plan_has_steps_with_filters_perception_labels_and_texts():
    first, second = parse_plan(
        "GoToXY?a P1 yaw=90 +LockHeading &TakeNote@last note=\"a; 'b'\" -param.arc; Ring 4 / Hold t"
    )
    assert first.call.label == "a" and first.call.arguments[1].value == 90.0
    assert [call.name for call in first.filters] == ["LockHeading"]
    note, arc = first.perceptions[0].arguments
    assert first.perceptions[0].at == "last" and note.value == "a; 'b'"
    assert (arc.kind, arc.value, arc.negative) == ("param", "arc", True)
    assert second.each and second.each.call.name == "Hold"
    assert parse_plan("") == ()
    named = parse_plan('"go.to" P1 &"night camera" note=x &snap')[0]
    assert [call.name for call in named.perceptions] == ["night camera", "snap"]


@pytest.mark.parametrize("plan", ["Go&", "GoToXY x=1.2.3", "Go@middle", "+Lock"])
def test_plans_that_do_not_parse(plan):
    with pytest.raises(TemplateError):
        parse_plan(plan if plan != "+Lock" else "Go ()")


@pytest.mark.parametrize(
    ("word", "article"),
    [
        *(("anchor", "an"), ("unit", "a"), ("umbrella", "an"), ("one-way", "a"), ("hour", "an")),
        *(("8-second", "an"), ("11 m", "an"), ("180-degree", "a"), ("18-degree", "an")),
        *(("ROV", "a"), ("MMSI 3", "an"), ("Ulv", "an"), ("X-7", "an"), ("B3", "a")),
    ],
)
def test_the_article_follows_the_sound(word, article):
    assert article_for(word) == article


def test_articles_gaps_and_capitals_are_put_right():
    pieces = [("a ", False), ("80-metre", True), (" orbit at", False), (" ", False), (" ,", False)]
    assert plain(joined(pieces)) == "An 80-metre orbit at"
    pieces = [("the ", False), ("the red buoy", True), ("  first. ", False), ("two m", True)]
    text = joined(pieces)
    assert text == f"The {VALUE_OPEN}red buoy{VALUE_CLOSE} first. {VALUE_OPEN}Two m{VALUE_CLOSE}"
    assert skeleton(text) == "The _ first. _"
    assert plain(joined([("every ", False), ("a minute", True)])) == "Every minute"
    assert plain(joined([("file ", False), ("run_4. ", True), ("then", False)], small=True)) == (
        "file run_4. then"
    )
