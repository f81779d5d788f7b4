"""Templates of whole commands: what can be written, and how a mistake is named."""

import pytest

from planner_ft.data.mission.synthetic.commands_check import (
    parse_template,
    read_templates,
    shipped_templates,
)
from planner_ft.data.mission.synthetic.commands_format import Choice, FormatError, parse_text
from planner_ft.support.errors import PlannerError


def parse(row: str):
    return parse_template(row, "subject", 7)


def test_alternatives_may_nest_and_marks_can_be_escaped():
    outer = parse_text(r"Go (now|(right |)away) \(please\)")
    assert isinstance(outer[1], Choice) and isinstance(outer[1].options[1][0], Choice)
    assert outer[2] == " (please)"


@pytest.mark.parametrize(
    ("row", "said"),
    [
        ("Hold at {P1} for {duration}.", "no ` => `"),
        ("Hold at {P1} for {duration}. => ", "no intents"),
        ("Hold at {P1. => KeepStation P1", "brace without its other half"),
        ("Hold (at {P1}. => KeepStation P1", "bracket is open"),
        ("Hold at {P1}). => KeepStation P1", "bracket or bar too many"),
        ("Hold (please) at {P1}. => KeepStation P1", "has no alternative"),
        ("Hold at {P1} for {time}. => KeepStation P1", "{time} is no slot"),
        ("Hold at {T}. => KeepStation T1", "{T} has no number"),
        ("Hold at {T1:ship}. => KeepStation T1", "no kind 'ship'"),
        (
            "Hold at {P1} for {duration}. => KeepStation P1",
            "{duration} is said, but belongs to no intent",
        ),
        ("Hold at {P1}. => KeepStation P1 duration", "TEXT has no {duration}"),
        ("Hold at {~P1}. => KeepStation here", "no intent has the right P1"),
        ("Hold (at {P1}|there). => KeepStation P1", "not every alternative says"),
        ("Hold for {duration}. => KeepStation duration", "has no place"),
        ("Hold at {P1} for {radius}. => KeepStation P1 radius", "KeepStation has no radius"),
        ("Hold at {P1}. => HoldStation P1", "no task 'HoldStation'"),
        ("Stay by {T1:boat}. => KeepStation T1", "is FollowTarget"),
        ("Half way round {T1}. => PerformOrbit T1 arc=half", "not a number"),
        ("Circle {T1} and {T2}. => PerformOrbit T1 T2", "T twice"),
        (
            "Circle {T1}, no checks. => PerformOrbit T1; Not Checking",
            "no task 'Checking' to rule out",
        ),
        (
            "Find {T1:boat}, then circle {T1:buoy}. => SearchAndDetect T1; PerformOrbit T1",
            "two kinds",
        ),
    ],
)
def test_mistakes_are_named(row, said):
    with pytest.raises(FormatError) as error:
        parse(row)
    assert said in str(error.value)


def test_a_slot_that_is_taken_back_can_be_named_among_the_arguments():
    template = parse("Go to {T1}, no, to {T2}. => Transit T2 ~T1")
    assert template.wrong == {"T1"} and template.lines[0].slots == ("T2",)


def test_kinds_follow_from_the_tasks():
    template = parse(
        "Follow {T1}, track {T2}, scan {T3}, dock at {T4}. => FollowTarget T1; SubseaCableTrack T2;"
        " BoatLandingClearanceSweep T3; DockingApproach T4"
    )
    assert template.kinds == {"T1": "boat", "T2": "cable", "T3": "landing", "T4": "dock"}


def test_a_file_is_read_with_its_problems(tmp_path):
    path = tmp_path / "odd.txt"
    path.write_text("# remark\n\nCome home. => Home\nGo (away. => Home\n", encoding="utf-8")
    templates, problems = read_templates(path)
    assert [template.number for template in templates] == [3]
    assert [str(problem).split(": ")[0] for problem in problems] == [f"{path}:4"]


def test_an_unreadable_file_is_a_user_error(tmp_path):
    with pytest.raises(PlannerError, match=r"missing\.txt"):
        read_templates(tmp_path / "missing.txt")


def test_templates_are_shipped():
    assert len(shipped_templates()) > 1000
    assert {"mixed", "positioning"} <= {template.subject for template in shipped_templates()}
