"""The sketch of a track."""

from __future__ import annotations

import pytest

from planner_ft.document.track import Boundary, Circle, Leg, Point, Target, Track
from planner_ft.review.chart import chart


def path(
    *points: Point,
    circles: tuple[Circle, ...] = (),
    boundaries: tuple[Boundary, ...] = (),
    targets: tuple[Target, ...] = (),
) -> Track:
    legs = (Leg("t1", 0, "GoToXY", "go", points, 0.0, 0.0),) if points else ()
    return Track(legs, circles, boundaries, targets, ())


def sketch(
    track: Track, columns: int = 60, rows: int = 16, braille: bool = True
) -> tuple[list[str], list[str]]:
    """The drawing, and the lines below it."""
    lines = chart(track, ["t1", "t2"], (0, 0), columns=columns, rows=rows, braille=braille)
    end = next((number for number, line in enumerate(lines) if "north is up" in line), 0)
    return lines[:end], lines[end:]


def place(drawing: list[str], mark: str) -> tuple[int, int]:
    """Column and row of a character."""
    row = next(number for number, line in enumerate(drawing) if mark in line)
    return drawing[row].index(mark), row


@pytest.mark.parametrize(
    ("end", "right", "down"),
    [((100, 0), 1, 0), ((-100, 0), -1, 0), ((0, 100), 0, -1), ((0, -100), 0, 1), ((50, 50), 1, -1)],
)
def test_east_is_right_and_north_is_up(end: Point, right: int, down: int) -> None:
    drawing, _legend = sketch(path((0, 0), end))
    (home_column, home_row), (column, row) = place(drawing, "H"), place(drawing, "1")
    assert (
        (column > home_column) - (column < home_column),
        (row > home_row) - (row < home_row),
    ) == (right, down)


@pytest.mark.parametrize("extent", [0.01, 7.0, 250.0, 1e6])
@pytest.mark.parametrize("braille", [True, False])
def test_it_fits_and_the_scale_bar_is_as_long_as_it_says(extent: float, braille: bool) -> None:
    drawing, legend = sketch(path((0, 0), (extent, 0)), braille=braille)
    assert len(drawing) <= 16 and all(len(line) <= 60 for line in drawing)
    bar = len(legend[0].split(" ")[0]) - 2
    metres = float(legend[0].split(" ")[1])
    per_column = extent / (place(drawing, "1")[0] - place(drawing, "H")[0])
    assert bar * per_column == pytest.approx(metres, rel=0.2)


def test_a_long_and_low_track_takes_few_rows() -> None:
    assert [len(sketch(path((0, 0), (100, north)))[0]) for north in (0, 5, 10, 99)] == [2, 4, 5, 16]


def test_circles_and_boundaries_are_drawn_around_what_they_enclose() -> None:
    circle = Circle("t1", (50, 0), 40, None)
    square = Boundary("t1", 0, ((0, -60), (120, -60), (120, 60), (0, 60)))
    plain = sketch(path((0, 0), (50, 0)))[0]
    drawing = sketch(path((0, 0), (50, 0), circles=(circle,), boundaries=(square,)))[0]
    assert len(drawing) > len(plain)
    middle = drawing[place(drawing, "1")[1]]
    assert sum(letter not in " " for letter in middle[middle.index("1") :]) >= 3


def test_a_boundary_is_closed_whichever_corner_it_begins_with() -> None:
    corners = ((0, -60), (120, -60), (120, 60), (0, 60))
    turned = [corners[first:] + corners[:first] for first in range(4)]
    drawings = [sketch(path(boundaries=(Boundary("t1", 0, one),)))[0] for one in turned]
    assert drawings[0] and all(drawing == drawings[0] for drawing in drawings)


def test_targets_without_a_place_stand_below_by_name() -> None:
    targets = (Target("green buoy", None, "t1"), Target("pier", (30.0, 4.5), "t2"))
    drawing, legend = sketch(path((0, 0), (50, 0), targets=targets))
    assert (
        "not located yet: green buoy" in legend
        and "* pier at [30, 4.5]" in legend
        and any("*" in line for line in drawing)
    )
    assert sketch(path(targets=targets[:1]))[1] == [
        "(nothing moves that can be drawn)",
        "not located yet: green buoy",
    ]


@pytest.mark.parametrize("far", [1e12, 1e308, -1e308])
def test_what_is_beyond_all_maps_is_left_out(far: float) -> None:
    assert "(nothing moves that can be drawn)" in sketch(path((0, 0), (far, 0)))[1]


def test_without_braille_there_is_only_ascii() -> None:
    assert all(
        "\n".join(part).isascii()
        for part in sketch(
            path((0, 0), (30, 40), circles=(Circle("t1", (0, 0), 10, 90),)), braille=False
        )
    )


ANGLE = path((0, 0), (100, 0), (100, 50))
AROUND = path(
    (0, 0),
    (50, 0),
    circles=(Circle("t1", (50, 0), 30, None),),
    boundaries=(Boundary("t1", 0, ((-20, -40), (90, -40), (90, 40))),),
)
DRAWINGS: list[tuple[Track, int, int, bool, str, str]] = [
    (
        ANGLE,
        30,
        8,
        False,
        """
                       1
                       .
                       .
                       .
                       .
 H......................
""",
        "|-----------| 50 m",
    ),
    (
        ANGLE,
        30,
        8,
        True,
        """
                       1
                       ⢸
                       ⢸
                       ⢸
                       ⢸
 H⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣸
""",
        "├───────────┤ 50 m",
    ),
    (
        path((0, 0), (60, -60)),
        20,
        6,
        True,
        """ H
 ⠈⠢⡀
   ⠈⠢⡀
     ⠈⠑⢄
        ⠑⢄
          1""",
        "├────────────────┤ 100 m",
    ),
    (
        AROUND,
        40,
        14,
        True,
        """
                               ⡠⠒⡇
                 ⢀⣀⠤⠤⠤⠤⠤⣀⡀  ⡠⠔⠉  ⡇
               ⡠⠔⠉       ⢈⠷⢮     ⡇
             ⢀⠞⠁      ⢀⠤⠊⠁  ⠑⡄   ⡇
             ⡎      ⡠⠒⠁      ⠘⡄  ⡇
            ⢸    ⡠⠔⠉          ⡇  ⡇
      H⠉⠉⠉⠉⠉⢹⠉⣉⠝⠋⠉⠉⠉⠉1        ⡇  ⡇
           ⢀⠤⢏               ⢠⠃  ⡇
        ⢀⡠⠒⠁ ⠈⢦⡀            ⡠⠃   ⡇
      ⡠⠔⠁      ⠑⠢⣀       ⢀⡴⠚     ⡇
   ⣀⠔⠊           ⠈⠉⠒⠒⠒⠒⠒⠉⠁       ⡇
 ⣤⣊⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⡇
""",
        "├───────────────┤ 50 m",
    ),
]


@pytest.mark.parametrize(("track", "columns", "rows", "braille", "drawn", "bar"), DRAWINGS)
def test_a_whole_drawing(
    track: Track, columns: int, rows: int, braille: bool, drawn: str, bar: str
) -> None:
    drawing, legend = sketch(track, columns, rows, braille)
    assert drawing == drawn.split("\n")
    assert legend == [f"{bar}   north is up   H home   1, 2, ... where that task ends"]


def test_a_drawing_has_78_columns_and_22_rows_unless_another_size_is_asked_for() -> None:
    wide, high = path((0, 0), (1000, 0)), path((0, 0), (0, 1000))
    for track in (wide, high):
        sized = chart(track, ["t1"], (0, 0), columns=78, rows=22, braille=True)
        assert chart(track, ["t1"], (0, 0)) == sized
    assert len(chart(high, ["t1"], (0, 0))) == 23
    assert len(chart(wide, ["t1"], (0, 0))) == 3, "a flat track has no empty rows"
    assert max(map(len, chart(wide, ["t1"], (0, 0))[:-1])) == 70


@pytest.mark.parametrize(("far", "drawn"), [(1e9, True), (-1e9, True), (1.01e9, False)])
def test_all_within_a_million_kilometres_is_drawn(far: float, drawn: bool) -> None:
    for end in ((far, 0.0), (0.0, far)):
        shown = "(nothing moves that can be drawn)" not in sketch(path((0, 0), end))[1]
        assert shown is drawn
    targets = (Target("pier", (far, 0.0), "t1"),)
    drawing, legend = sketch(path((0, 0), (9, 0), targets=targets))
    assert any("*" in line for line in drawing) is drawn and f"* pier at [{far:g}, 0]" in legend


def test_what_is_written_first_stays_and_only_the_tasks_of_the_plan_have_a_number() -> None:
    on_home = Target("pier", (0.0, 0.0), "t1")
    drawing, _legend = sketch(path((0, 0), (50, 0), targets=(on_home,)))
    assert not any("*" in line for line in drawing)
    legs = [
        Leg(f"t{at}", 0, "GoToXY", "go", ((0, 0), (30.0 * at, 0)), 0.0, 0.0) for at in (1, 2, 3)
    ]
    hold = Leg("t2", 1, "StationKeep", "hold", (), 0.0, 9.0)
    drawing, _legend = sketch(Track((*legs, hold), (), (), (), ()))
    assert "1" in str(drawing) and "2" in str(drawing) and "3" not in str(drawing)
