"""Numbers of a text with their units, however they are said."""

from __future__ import annotations

import re

import pytest

from planner_ft.facts import WAYPOINT, read
from planner_ft.facts.numbers import in_unit, read_numbers
from planner_ft.facts.places import rows_of_sizes
from planner_ft.facts.together import neighbours, pairs
from planner_ft.vocabulary import Parameter


def states(text: str, value: float, unit: str | None) -> str:
    return read(text).evidence(value, Parameter("it", "number", unit)).kind


SAID = """
    {four minutes = 240 s} | {a kilometre = 1000 m} | for {a minute and a half = 90 s}
    {two and a half minutes = 150 s} | {half an hour = 1800 s}
    {one minute's = 60 s} hold, a {two-hour = 7200 s} watch
    {three quarters of an hour = 2700 s} | {one point two kilometres = 1200 m}
    {one decimal five kilometres = 1500 m} | {two hundred and fifty metres = 250 m}
    heading {one two zero = 120 *} | {half a metre per second = 0.5 m/s}
    a reading {every minute = 60 s} | a {ten-minute = 600 s} drift | {20 minuets = 1200 s}
    {1,200 m = 1200 m} | [{1 = 1},{200 = 200}] | {100 = 100} by {60 = 60}
    {100 = 91.44 m} by {50 yards = 45.72 m} | {20 = 20 m}*{20 m = 20 m}
    {100 = 30.48 m}x{60 = 18.288 m}x{20 ft = 6.096 m} | {niner zero = 90}, {minus two five = -25}
    lanes {one zero metres = 10 m} apart | {3m30s = 210 s}
    {9 minutes = 540 s} and {half an hour = 1800 s} | {two = 2} {five-minute = 300 s} holds
    hold {two-five minutes = 1500 s} | hold {two = 2}-{three minutes = 180 s}
    {point five knots = 0.257222 m/s} | {0,5 m/s = 0.5 m/s}
    {zero nine zero = 90} {two hundred metres = 200 m} | {75 = 75} by {40 = 40} lanes
    {minus one ten = -110} comma {one twenty five = 125} | at {one fifty = 150} comma {ninety = 90}
    {2/3 = 0.666667} of it | {5 = 5}/{5 = 5} and {5 = 5}/{35 = 35} | {.5 m/s = 0.5 m/s}
    {two metres a second = 2 m/s} | {18 km/h = 5 m/s} | {a full hour = 3600 s}
    {three-quarter = 0.75} circle | {one thousand six hundred and seventy-four metres = 1674 m}
    {quarter of an horu = 900 s} | {one n a half hours = 5400 s} | {every mnute = 60 s}
    {5 knots = 2.57222 m/s} | {10 mph = 4.4704 m/s} | {2 m s-1 = 2 m/s}
    {forty five = 45}, {20 percent = 20 %} | {20 per cent = 20 %} of {40 m = 40 m}
    face {297 = 297} - record the radar | {a minute and three quarters = 105 s}
    {one and three quarter hours = 6300 s} | {two hours and two thirds = 9600 s}
    {1 3/4 minutes = 105 s} | {a minute = 60 s} and {three quarters = 0.75} of a turn
    {a minute = 60 s} and {three quarter = 0.75 *} turns | {50 inches = 1.27 m} | nothing to see
    hold for {90 s = 90 s} | {1,250,000 m = 1250000 m} and {12,500 seconds = 12500 s}
    {0.5 m = 0.5 m} | {1e3 m = 1000 m} | {2e+2 metres = 200 m} | {1.5e3 m = 1500 m} | a2e{3 m = 3 m}
    {1/2 a mile = 926 m} | {3/4 mile = 1389 m} | {2 = 2}/{6 = 6} of it | {7/8 of a mile = 1620.5 m}
    {½ hour = 1800 s} | {2 ½ hours = 9000 s} | {2½ m = 2.5 m} | {¼ mile = 463 m}, {¾ mile = 1389 m}
    {⅓ of an hour = 1200 s} | {⅔ of an hour = 2400 s} | {⅛ of a mile = 231.5 m}
    {1 1/2 hours = 5400 s} | {2 1/4 miles = 4167 m} | {5 = 5} {3/4 = 0.75 *} waypoints
    {20 and a half metres = 20.5 m} | {20 and one half metres = 20.5 m}
    {an hour and a quarter = 4500 s} | {an hour and half = 5400 s}
    {three and three quarters minutes = 225 s} | {three and three quarter minutes = 225 s}
    {two hours and two quarters = 9000 s} | {an hour and 1/4 = 4500 s} | {minus five metres = -5 m}
    {negative 5 m = -5 m} | {-5 m = -5 m} | {–5 m = -5 m} | a-{5 m = 5 m} | {5 = 5}-{6 m = 6 m}
    x{-5 = -5} y{-6 = -6} | x {-5 = -5} y {-6 = -6} | ({3 = 3})-{4 = 4} | {5 = 5} {-6 m = -6 m}
    {ten = 10} - {5 m = 5 m} | between {5 = 5} - {6 m = 6 m} | {two hundred = 200}
    {two hundred five = 205} | {two hundred and five = 205} | {two hundred and ninety-five = 295}
    {two hundred = 200} and {one hundred = 100} | {one hundred twenty three metres = 123 m}
    {nine hundred ninety nine thousand = 999000} | {two thousand and five = 2005}
    {two thousand five hundred = 2500} | {one thousand = 1000} | {thousand metres = 1000 m}
    {a thousand metres = 1000 m} | {a hundred metres = 100 m} | {a couple of metres = 2 m}
    {a dozen metres = 12 m} | {half a dozen metres = 6 m} | {two dozen metres = 24 m}
    {three score metres = 60 m} | {twenty five = 25} | {twenty-five metres = 25 m}
    {thirty = 30} {ten = 10} | {twenty = 20} and {five metres = 5 m}
    {one two three metres = 123 m} | {one two three four = 1234} | {zero = 0} {five metres = 5 m}
    {niner five = 95} | {one hundred = 100} {one hundred = 100} | {one = 1 *} {eighty = 80}
    {two = 2} {twenty-five metres = 25 m} | {one point five metres = 1.5 m}
    {one point zero five metres = 1.05 m} | {zero point five metres = 0.5 m}
    {twenty point two five metres = 20.25 m} | {two decimal five m = 2.5 m} | {six zero decimal five = 60.5} | {one = 1 *} point buoy
    {five = 5} {six metres = 6 m} | {five zero metres = 50 m} | {five = 5}-{six metres = 6 m}
    {five-seven metres = 57 m} | {five = 5} {six minute = 360 s} holds
    {seventy one hundred and eighty = 7180} | {fourty metres = 40 m} | {a tenth of a mile = 185.2 m}
    {two tenths of a mile = 370.4 m} | {a fifth of an hour = 720 s}
    {a twentieth of an hour = 180 s} | the tenth buoy | a tenth of miles
    {a third of an hour = 1200 s} | {two thirds of an hour = 2400 s}
    {two-thirds of a mile = 1234.67 m} | {per minute = 60 s} | {each hour = 3600 s}
    {every second = 1 s} | an s | a m | a bar | a ° | {every day = 86400 s} | {a mile = 1852 m}
    {a nautical mile = 1852 m} | {a full minute = 60 s} | {a good solid hour = 3600 s}
    {a whole nautical mile = 1852 m} | {5 of a nautical mile = 9260 m}
    {5 = 5} full good whole solid metres | {20 per cent = 20 %} | {20 percent = 20 %}
    {20 % = 20 %} | {20 = 20} {per hour = 3600 s} | {5 = 5} {per centimetre = 0.01 m}
    {half a right angle = 45 deg} | {a right angle = 90 deg} | {two right angles = 180 deg}
    {a right angle = 90 deg} {30 m = 30 m} | right angle | right-angle turn
    every {other minute = 120 s} | every {other day = 172800 s}
    every other s | every other buoy | {three m = 3 m} {thirty s = 30 s} | {3 m 30 s = 210 s}
    {3 min 30 sec = 210 s} | {3 min 30 s = 210 s} | {5 m = 5 m} {30 = 30 *} buoys | {40 = 40}S
    {40 = 40} S | {40 s = 40 s} | {5 m/s = 5 m/s} | {5 m / s = 5 m/s} | {5 m per second = 5 m/s}
    {5 metres an hour = 0.00138889 m/s} | {5 metres each second = 5 m/s}
    {5 metres every minute = 0.0833333 m/s} | {5 metres, per second = 5 m/s}
    {5 metres = 5 m} per buoy | {5 m s-1 = 5 m/s} | {5 m s - 1 = 5 m/s} | {5 km/h = 1.38889 m/s}
    {5 km per hour = 1.38889 m/s} | {5 km a day = 0.0578704 m/s} | {5 s = 5 s}/m
    {2 metre = 2 m} second | {2 metre = 2 m} buoy | {4 an hour = 14400 s} | {four an hour = 14400 s}
    {2 h = 7200 s} {20 min = 1200 s} | {200 = 60.96 m} by {120 feet = 36.576 m}
    {200 = 200} by {120 = 120} | {100 = 100 m}x{60 = 60 m}x{20 m = 20 m}
    {100 = 30.48 m} x {60 ft = 18.288 m} and {5 m = 5 m} | {5 m = 5 m} by {3 = 3}
    {3 = 3 m} × {4 m = 4 m} | {3 = 3 m}*{4 m = 4 m} | the first {5 = 5}, then {6 yards = 5.4864 m}
    {two = 2 *} cables | a cable away | {2 = 2} cable lengths | {2 = 2} cables' lengths
    a cable tray | {5 = 5 *} points of the compass | {2 = 2 *} points to starboard
    {two = 2 *} points further to port | {two = 2 *} points of interest
    {2 = 2 *} points off the bow | {1.5 = 1.5 *} points on the beam | {5 = 5} cable
    heading {045 = 45 *} | heading of {045 = 45 *} | steer {45 = 45 *} | course {90 m = 90 m}
    bearing to {10 = 10 *} | azimuth: {30 = 30 *} | course is {270 = 270 *}
    of course {5 = 5 *} buoys | {045 = 45 *} | {005 = 5 *} buoys | {45 = 45 *} buoys
    {5 minutes = 300 s} | {5 mintues = 300 s} | {5 = 5} buoys' ropes | {5 = 5} towards the pier
    {5 = 5} less | the second hour | {a second = 1 s *} time | {a second = 1 s} buoy
    {a second = 1 s *} pass over it | {one second = 1 s} | the {one = 1 *} | {one = 1 *} of them
    the {one two = 12} | at {one = 1}, turn | {one = 1} {five metres = 5 m} | the other {one = 1 *}
    {half = 0.5 *} | {half = 0.5 *} of it | and {half = 0.5} | {five and half = 5.5}
    a {quarter = 0.25 *} | a {half = 0.5 *} | P-101 | P101 | pump P-101 at {3 bar = 300000 Pa}
    11-TK-7 | TK7 | T142 | b2 | for{30 min = 1800 s} | x{40 = 40} | n{40 = 40} | N {40 = 40} | N-40
    e-5 | y/{5 = 5} | {seven = 7}{5 = 5} | wait{5 = 5} | wait-5 | Radius{5 = 5} | RADIUS5 | radius-5
    radius_5 | A5 | 4-P-1 | 20-AB-3 valves | until 14:30 hold {5 = 5} | 2:30 | 123:45
    {1234 = 1234}:{30 = 30} | at 4:30, {6 = 6} | 4:30 and {45 = 45} | {tree minutes = 180 s}
    {tree metres = 3 m} | the tree | {fife zero = 50} | {niner-five = 95} | {ait-fife = 85}
    {tree five = 35} | {fower days = 345600 s} | {two = 2} tree
    at {two hundred = 200} and {one hundred = 100} | {one hundred = 100} {one hundred = 100}
    {hundred hundred metres = 10000 m} | keep {30 fet = 9.144 m} off
    {one hundred and five = 105} | {a hundred and twenty metres = 120 m}
"""
"""Texts with their numbers: {words = value unit}, with a star where they count things."""
_SAID = re.compile(r"\{(.*?) = (\S+?)(?: ([^ *]+?))?( \*)?\}")


@pytest.mark.parametrize(
    "marked", [one.strip() for line in SAID.splitlines() for one in line.split("|") if one.strip()]
)
def test_numbers_are_read_with_their_words_and_unit(marked: str) -> None:
    found = read_numbers(text := _SAID.sub(r"\1", marked))
    words, values, units, stars = zip(*_SAID.findall(marked), strict=True) if found else [()] * 4
    assert tuple(text[one.start : one.end] for one in found) == words
    assert [one.value for one in found] == pytest.approx([*map(float, values)], rel=1e-5)
    assert tuple((one.unit or "", one.counts) for one in found) == tuple(
        (unit, bool(star)) for unit, star in zip(units, stars, strict=True)
    )


VALUES = """
    at two hundred and one hundred |  | 100 200
    one hundred one hundred |  | 100
    one eighty |  | 1 80 180
    one eighty | deg | 1 80 180
    two twenty-five metres | m | 2 25 225
    nine ninety-nine |  | 9 99 999
    one two three metres | m | 1 2 3 12 23 123
    five six minute holds | s | 5 360 3360
    hold two-five minutes | s | 2 300 1500
    two and a half hour | s | 2 1800 9000
    at 4 m and a half hour of film | s | 1800
    at 4 m and a half hour of film | m | 4 4.5
    half a minute | s | 30
    7,5 m off and 2,5 knots | m | 7.5
    12,5 m off for 2,5 min | m | 12.5
    a 60-by-40 grid | m | 40 60
    12,5 m off for 2,5 min | s | 150
    7,5 m off and 2,5 knots | m/s | 1.286111
    at point five knots | m/s | 0.257222
    to the point five knots | m/s | 2.572222
    for point five minutes | s | 30 300
    hold minute | s | 60
    for a minute and half a metre | s | 60
    for a minute and half a metre | m | 0.5
    2:30 | s | 150 9000
    from 11:10 to 11:30 | s | 670 690 1200 40200 41400
    hold from half past eight to nine | s | 8 9 1800
    noon to half past twelve | s | 12 1800
    quarter to twelve till ten past one | s | 10 12 5100
    between 2350 and 0010 on station | s | 10 1200 2350
    from eight to nine | s | 8 9
    hold 80 s and a quarter of an hour | s | 80 900
    hovr five seconds | s | 5 3600 3605
    from 23:50 to 00:20 | s | 20 1200 1430 1800 85800
    11:10 ......... 11:30 | s | 670 690 40200 41400
    11:10 .......... 11:30 | s | 670 690 40200 41400
    2 minutes and 30 seconds | s | 30 120 150
    2 minutes 30 | s | 30 120 150
    2 h 20 min | s | 8400
    2 h 20 min 30 s | s | 8430
    20 min 2 h | s | 1200 7200 8400
    2 min 90 s | s | 210
    2 minutes, 30 | s | 30 120
    2 minutes  30 | s | 30 120
    5 foot 6 | m | 1.524 1.6764 1.8288 6
    5 foot 6 inches | m | 0.1524 1.524 1.6764
    5 foot 12 | m | 1.524 3.6576 12
    5 foot 6 metres | m | 1.524 6
    5 yards 6 | m | 4.572 5.4864 6
    5 foot 0 | m | 0 1.524
    ten minutes here and five there | s | 5 300 600
    ten minutes at 25,85; sorry, make that five | s | 5 300 600
    ten minutes here and fifty there | s | 50 600
    ten minutes here and 51 there | s | 51 600
    ten minutes here and two there | s | 2 600
    ten minutes here and one there | s | 600
    ten metres here and five there | m | 5 10
    ten metres here and five buoys | m | 10
    ten m/s here and five there | m/s | 5 10
    0 minutes here and five there | s | 0 5
    twice, thrice and once |  | 1 2 3
    twice, thrice and once | count | 1 2 3
    twice, thrice and once | m |
    40 percent | % | 40
    0.5 | % | 0.5 50
    1 | % | 1
    a quarter overlap | % | 0.25 25
    65 degrees | °C | 65
    65 degrees | °F | 65
    65 degrees | deg | 65
    30 km | m | 30000
    30 km | km | 30
    30 m | km | 0.03
    24 V | V | 24
    24 V | m | 24
    24 V or 12 | V | 12 24
    24 s | V |
    3 furlongs | furlong | 3
    3 furlongs | m | 3
    7 NTU | NTU | 7
    [40, 12] 5 m | m | 5
    40, 12 5 m | m | 5 12 40
    x 40 y 12 | m |
    two buoys | m |
    two buoys | count | 2
    two cables | m | 370.4
    half a cable length | m | 92.6
    2 points to starboard | deg | 2 22.5
    heading 045 | deg | 45
    heading 045 | m |
    three m thirty s | s | 30
    three m thirty s | m | 3
    one metre second | m/s | 1
    drift 4 an hour | s | 4 3600 14400
    11:10 ....... 11:30 | s | 670 690 1200 40200 41400
    11:10 and 5 11:30 | s | 5 670 690 40200 41400
    9:05 | s | 545 32700
    one eighty three |  | 1 3 80 83 183
    five eighteen |  | 5 18 518
    zero fifty |  | 0 50
    ten fifty |  | 10 50
    two ten metres | m | 2 10 210
    two sixty nine metres | m | 2 9 60 69 269
    two sixty metres | m | 2 60 260
    twenty-five six metres | m | 6 25
    two hundred sixty |  | 260
    half a turn | deg | 0.5
    three quarters of the way round | deg | 0.75
    once round | deg |
    all the way round | deg |
    two thirds round | deg | 0.666667
    1.5 round | deg | 1.5
    2 laps | deg | 2
    2 more | deg | 2
    a third of a turn | deg | 0.333333
    three full turns | deg | 3
    north-east | deg |
    40 degrees to the west | deg | 40
    -40 degrees | deg | -40
"""
"""Texts, a unit, and all values that a parameter in that unit can have from the text."""


@pytest.mark.parametrize("row", VALUES.strip().splitlines())
def test_all_values_that_a_text_can_give_a_parameter(row: str) -> None:
    text, unit, values = (part.strip() for part in row.split("|"))
    found = dict.fromkeys(one.value for one in read(text).numbers(unit or None))
    assert list(found) == pytest.approx([*map(float, values.split())], rel=1e-5)


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("hold for hour or so", 3600, "s"),
        ("waiting minute at each", 60, "s"),
        ("for next minute and half", 90, "s"),
        ("holding full minute on each heading", 60, "s"),
        ("two and a half hous adrift", 9000, "s"),
        ("a full hur on video", 3600, "s"),
        ("drift 4 an hour and a half", 5400, "s"),
        ("for a couple of minutes", 120, "s"),
        ("a score of minutes", 1200, "s"),
        ("every 2:30", 150, "s"),
        ("a tenth of an hour on station", 360, "s"),
        ("three tenths of a mile", 555.6, "m"),
        ("a twentieth of a nautical mile", 92.6, "m"),
        ("an eighth of a turn to port", 45, "deg"),
        ("for tree minutes", 180, "s"),
        ("in a wun zero metre circle", 10, "m"),
        ("half a cable off", 92.6, "m"),
        ("heading like one eighty", 180, "deg"),
        ("come to two twenty-five", 225, "deg"),
        ("two cables out", 370.4, "m"),
        ("2:30 hours", 9000, "s"),
        ("1½ hours", 5400, "s"),
        ("for an hour and ten minutes, a reading every five", 300, "s"),
        ("three quartesr of an hour", 2700, "s"),
        ("at 4 m and a half hour of film", 4, "m"),
        ("at 4 m and a half hour of film", 1800, "s"),
        ("500 fewt by 170", 152.4, "m"),
        ("20 yards off", 18.288, "m"),
        ("from 22/0 a kilometre", 1000, "m"),
        ("1,250 out", 1250, "m"),
        ("at one metre second", 1, "m/s"),
        ("at one metre per secodn", 1, "m/s"),
        ("0.2 mrtres per second", 0.2, "m/s"),
        ("a dozen headings", 12, "count"),
        ("half a dozen headings", 6, "count"),
        ("two dozen", 24, "count"),
        ("eight secotrs", 8, "count"),
        ("a quarter overlap", 25, "%"),
        ("fifty per cent", 50, "%"),
        ("go round it onec", 360, "deg"),
        ("one time around", 360, "deg"),
        ("south-bound", 180, "deg"),
        ("the cable, sw, 917 metres", 225, "deg"),
        ("lanes one five metres apart", 15, "m"),
        ("a field of view of three zero degrees", 30, "deg"),
    ],
)
def test_values_are_found_however_they_are_said(text: str, value: float, unit: str) -> None:
    assert states(text, value, unit) != "nobody"


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("hold for eight minutes", 8, "m"),
        ("seventy-five metres", 5, "m"),
        ("the second buoy", 1, "s"),
        ("45 minus 12", 2700, "s"),
        ("ten metres", 10, "s"),
        ("thirty seconds", 30, "m"),
        ("nothing", 1, "s"),
        ("two feet 5 metres", 1, "m"),
        ("1 of them", 100, "%"),
        ("by the tree, on the fifth leg", 3, "s"),
    ],
)
def test_values_that_nobody_said_are_not_found(text: str, value: float, unit: str) -> None:
    assert states(text, value, unit) == "nobody"


@pytest.mark.parametrize(
    ("text", "value", "unit", "kind", "words"),
    [
        ("hold for 20 s", 20, "s", "stated", "20 s"),
        ("hold for eight minutes", 480, "s", "converted", "eight minutes"),
        ("2 minutes and 30 seconds", 150, "s", "derived", "2 minutes and 30 seconds"),
        ("5 minutes 30", 330, "s", "derived", "5 minutes 30"),
        ("2 h 30", 9000, "s", "derived", "2 h 30"),
        ("2 foot 6 off", 0.762, "m", "derived", "2 foot 6"),
        ("two minutes, no, three", 180, "s", "converted", "three"),
        ("ten minutes here and five there", 300, "s", "converted", "five"),
        ("speed 1.5, please", 1.5, "m/s", "stated", "1.5"),
        ("wait minute at each", 60, "s", "converted", "minute"),
        ("for twenty minuets", 1200, "s", "converted", "twenty minuets"),
        ("go half round it", 180, "deg", "derived", "half"),
        ("go to the north-west", 315, "deg", "stated", "north-west"),
        ("at minus 40 degrees", -40, "deg", "stated", "minus 40 degrees"),
        ("100x60 m", 100, "m", "stated", "100"),
        ("20x20 lanes of 5 m", 20, "m", "stated", "20"),
        ("a ½ mile", 926, "m", "converted", "½ mile"),
    ],
)
def test_a_value_comes_with_its_kind_and_its_words(
    text: str, value: float, unit: str, kind: str, words: str
) -> None:
    found = read(text).evidence(value, Parameter("it", "number", unit))
    assert found.kind == kind
    assert [text[start:end].strip() for start, end in found.spans] == [words]


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("Survey the two wrecks", 2, "m"),
        ("Go to [120, -35] and hold", 120, "m"),
        ("the other one", 1, "m"),
        ("heading 045", 45, "m"),
        ("2 h 20 min", 7200, "s"),
        ("circle the buoy", 360, "deg"),
        ("hold for eight minutes", 8, "s"),
    ],
)
def test_counts_coordinates_and_parts_are_no_measures(text: str, value: float, unit: str) -> None:
    assert states(text, value, unit) == "nobody"


@pytest.mark.parametrize("text", ["three furlongs off", "at 1.2.3 m", "10^3 m", "0x20 m", "12'6 m"])
def test_numbers_that_cannot_be_read_are_not_judged(text: str) -> None:
    assert read(text).unread
    assert states(text, 77, "m") == "unread"


@pytest.mark.parametrize("text", ["a 20x20 m box", "100x60 m", "100 × 60 m", "a 100 × 10 m box"])
def test_areas_can_be_read(text: str) -> None:
    assert read(text).unread == ()


def test_scoring_allows_two_per_cent_and_the_document_none() -> None:
    radius = Parameter("radius", "number", "m")
    assert read("at 500 m").evidence(505, radius).kind == "nobody"
    assert read("at 500 m").evidence(505, radius, tolerance=0.02).kind == "stated"
    assert read("at 500 m").evidence(511, radius, tolerance=0.02).kind == "nobody"


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("hold from 11:10 to 11:30", 1200, "s"),
        ("between 23:50 and 00:20 keep station", 1800, "s"),
        ("a still every other minute", 120, "s"),
        ("turn half a right angle to port", 45, "deg"),
        ("turn through a right angle", 90, "deg"),
        ("two right angles", 180, "deg"),
    ],
)
def test_values_that_words_stand_for(text: str, value: float, unit: str) -> None:
    assert states(text, value, unit) in ("stated", "converted", "derived")


def test_scoring_allows_half_a_metre_of_a_place_at_most() -> None:
    for place, allowed in (([10.2, 0], True), ([10.3, 0], False)):
        found = read("go to [10, 0]").evidence(place, WAYPOINT, tolerance=0.02)
        assert (found.kind == "stated") == allowed
    for place, allowed in (([1000.5, 0], True), ([1000.6, 0], False)):
        found = read("go to [1000, 0]").evidence(place, WAYPOINT, tolerance=0.02)
        assert (found.kind == "stated") == allowed


def test_a_misspelt_word_behind_a_number_is_a_unit() -> None:
    """The likeliest correction of "fet" is "get"; where no number stands before it, it may be."""
    radius = Parameter("radius", "number", "m")
    assert read("keep 30 fet off").evidence(9.144, radius).given
    assert not read("keep 30 m off and fet it").evidence(9.144, radius).given


def test_figures_of_a_clock_time_are_no_values() -> None:
    text = "Do nothing until 14:30, then hold at [75, 75]."
    assert [number.value for number in read_numbers(text)] == [75, 75]
    assert {14, 30}.isdisjoint(number.value for number in in_unit(text, "s"))
    assert 150 in [number.value for number in in_unit("Hold for 2:30.", "s")]


def test_sizes_that_are_said_together() -> None:
    def sizes(text: str) -> list[list[float]]:
        return [[one.value for one in row] for row in rows_of_sizes(text)]

    assert sizes("50 by 60 m, then 7 m; 100x60x20, 5 and 6") == [[50, 60], [100, 60, 20]]
    assert sizes("7 m, 5 and 6") == sizes("") == []


def test_numbers_beside_each_other_are_within_some_characters() -> None:
    numbers = read_numbers("1 2  3    4")
    assert [(one.value, two.value) for one, two in pairs(numbers, 2)] == [(1, 2), (2, 3)]
    assert len(list(pairs(numbers, 9))) == 6
    found = neighbours(read_numbers("2 min and 30 s, then 5 h"), "s")
    assert [(one.value, one.start, one.end) for one in found] == [(150, 0, 14)]


def test_figures_without_an_end_are_one_number() -> None:
    assert len(read_numbers("at " + "9" * 400 + " a minute")) == 1
