"""What a command takes back, gives anew, or tells of others: tasks, places, values."""

from __future__ import annotations

import pytest

from planner_ft.decoding.constraints.grounded_mission import read_told
from planner_ft.decoding.constraints.reading.missions.homeward import home_meant
from planner_ft.decoding.constraints.reading.missions.others import places_of_others
from planner_ft.decoding.constraints.reading.missions.renewed import outdated, read_spacing
from planner_ft.decoding.constraints.reading.missions.sections import read_sections
from planner_ft.decoding.constraints.reading.missions.taken_back import (
    dropped_titles,
    places_taken_back,
)

HOME = (0.0, 0.0)


@pytest.mark.parametrize(
    ("command", "dropped"),
    [
        (
            (
                "Find the tender and orbit it at 9 m. Scratch the orbit, fog is coming: hold beside"
                " it for a minute."
            ),
            ["PerformOrbit"],
        ),
        ("Panorama from [4, 40], then a report. Forget the report.", ["AutoGenerateReportSummary"]),
        (
            (
                "Look for the skiff and film its bow. She lies at [40, 9] as we hear, so drop the"
                " search."
            ),
            ["SearchAndDetect"],
        ),
        (
            "A sensor check, then survey the cone at [3, 30]. The sensor check is cancelled.",
            ["Diagnostics"],
        ),
        ("Circle the cone at [3, 30]. Don't forget the report.", []),
        ("Go to [41, 6], skip the post-mission report.", ["AutoGenerateReportSummary"]),
        ("Circle the cone at [3, 30] and the can at [9, 80]. At [9, 80] skip the circling.", []),
        ("Scratch the circling for now; first film the bow, then circle it.", []),
        ("Skip the first panorama, take the second one at [9, 9].", []),
    ],
)
def test_tasks_that_are_taken_back(command: str, dropped: list[str]) -> None:
    assert list(dropped_titles(command)) == dropped


@pytest.mark.parametrize(
    ("command", "places"),
    [
        (
            "Survey the buoys at [1, 20], [1, 40] and [1, 60], but leave out the middle one.",
            [(1, 40)],
        ),
        (
            "Hold a minute at each of [1, 20], [1, 40] and [1, 60], all but the northernmost one.",
            [(1, 60)],
        ),
        ("Survey [1, 20], [1, 40] and [1, 60] at 9 m except the last, which needs 12 m.", []),
        ("Dock at [5, 2]. That berth is occupied, so use [9, -4].", [(5, 2)]),
        ("Dock at [5, 2]. That berth is small, so come in slowly from [9, -4].", []),
        ("Hold at [5, 20]. Sorry, I had the wrong sheet, it is [5, 22].", [(5, 20)]),
        ("Hold at [5, 20] for two minutes, sorry, three, and then at [5, 22].", []),
        ("Hold at [5, 20], no, sorry, [5, 22]; then go back to the first point.", []),
        ("Forget the drift at [50, 0]. The hold at [60, 0] stands.", [(50, 0)]),
        ("Forget the drift at [50, 0], a panorama there will do.", []),
        ("The panorama at [50, 0] is cancelled, the hold at [60, 0] is not.", [(50, 0)]),
        ("Once the grid at [50, 0] is finished, send the log and wait at [60, 0].", []),
        ("The mast at [50, 0] is closed until noon, so wait at [60, 0].", []),
        ("Hold at [60, 9] for a minute, then home. No, not home, dock at [2, 2].", [HOME]),
        ("Hold at [60, 9]. Instead of coming home, wait at [2, 2].", [HOME]),
        ("Hold at [60, 9], then home, but not into the dock.", []),
    ],
)
def test_places_that_are_taken_back(command: str, places: list[tuple[float, float]]) -> None:
    assert list(places_taken_back(command, HOME)) == places


@pytest.mark.parametrize(
    ("command", "places"),
    [
        (
            (
                "Skua holds at [8, 8] all day and Plover docks at [9, 1], none of your business."
                " Film the lamp at [30, 4]."
            ),
            [(8, 8), (9, 1)],
        ),
        ("Skua is surveying the box at [8, 8]. You take the one at [40, 8].", [(8, 8)]),
        (
            "The other boat is working at [8, 8], which is not your concern. Drift at [40, 8].",
            [(8, 8)],
        ),
        ("Skua lies at [8, 8]. Circle her at 20 m.", []),
        ("Hold at [8, 8], no report for you to write.", []),
    ],
)
def test_places_of_others(command: str, places: list[tuple[float, float]]) -> None:
    assert list(places_of_others(command)) == places


@pytest.mark.parametrize(
    ("command", "old"),
    [
        ("Depth grid at [9, 90], 70 by 40, spacing 6. The spacing goes up to 8.", {6}),
        ("Circle the can at [9, 90] at a radius of 14 m. Make the radius 20.", {14}),
        ("A run along the north face, 30 m, 5 m off. 30 is too long, make it 22.", {30}),
        ("A run along the north face, 9 m off. Oops, seven metres rather than nine.", {9}),
        ("Hold at [9, 90] for ten minutes. Make it twelve minutes.", {600}),
        ("Readings every 20 seconds at [9, 90]. Correction: every 40 seconds.", {20}),
        ("Hold at [9, 90] for ten minutes. Make it twelve minutes. No, ten was right.", set()),
        (
            "Film the bow for 50 seconds at [9, 90]. Correction on the film: 35 seconds, not 50.",
            {50},
        ),
        ("Hold for ten minutes at [9, 90] and for twelve minutes at [9, 99].", set()),
    ],
)
def test_values_that_are_given_anew(command: str, old: set[float]) -> None:
    assert outdated(command) == old


@pytest.mark.parametrize(
    ("command", "spacing"),
    [
        ("Depth grid at [9, 90], 70 by 40, lines 6 m apart.", 6),
        ("Depth grid at [9, 90], 70 by 40, spacing 6. The spacing goes up to 8.", 8),
        ("Soundings at [9, 90] and at [9, 200], 5 m lanes in the first, 8 in the second.", None),
        ("Depth grid at [9, 90], 70 by 40.", None),
    ],
)
def test_spacing(command: str, spacing: float | None) -> None:
    assert read_spacing(command) == spacing


def test_sections_have_values_of_their_own() -> None:
    apart = read_sections(
        "Mole 1, at [8, 0]: a 40 m pass of the west side, 6 m off. Mole 2, at [90, 0]: the east"
        " side, 25 m, 9 m off."
    )
    assert apart == {(8, 0): {"m": frozenset({40, 6})}, (90, 0): {"m": frozenset({25, 9})}}
    assert (
        read_sections("Mole 1, at [8, 0]: a 40 m pass, 6 m off. Mole 2, at [90, 0]: the same.")
        == {}
    )
    assert (
        read_sections(
            "Keep 6 m off. Mole 1, at [8, 0]: a 40 m pass. Mole 2, at [90, 0]: a 20 m pass."
        )
        == {}
    )


def test_whether_home_is_spoken_of() -> None:
    assert not home_meant("Hold at [9, 90] for a minute, then film the mast.")
    assert home_meant("hld at [9, 90] thn cum hoam") and home_meant(
        "Hold at [9, 90], then head back."
    )


def test_a_sentence_about_the_weather_is_no_search() -> None:
    assert read_told(
        "Wind 200 at 9 knots, barometer 1011. Panorama from [4, 40], 6 sectors."
    ).placed
    assert not read_told(
        "Wind 200 at 9 knots, find the tender. Panorama from [4, 40], 6 sectors."
    ).placed
