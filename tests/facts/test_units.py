"""A parameter has the value that a text says, in the parameter's own unit, and no other figure."""

from __future__ import annotations

import pytest

from planner_ft.facts import read
from planner_ft.facts.units import converted, named
from planner_ft.vocabulary import Parameter

SAID = """
    alarm above 65 degrees | °C | 65 |
    alarm above 65 degrees | °F | 65 |
    alarm above 65 degrees Celsius | degC | 65 |
    warn at 90C | °C | 90 |
    warn at 176 F | °C | 80 | 176
    warn at 176 degrees fahrenheit | °C | 80 | 176
    warn at 350 K | °C | 76.85 | 350
    alarm at 700 kPa | bar | 7 | 700 70
    alarm at six bar | kPa | 600 | 6
    alarm at 10 psi | bar | 0.69 | 10
    alarm at 250 mbar | bar | 0.25 | 250
    fetch 500 g of grease | kg | 0.5 | 500
    fetch half a kilo of bolts | kg | 0.5 |
    fetch a kilo of bolts | kg | 1 |
    fetch 2 t of sand | kg | 2000 | 2
    fetch 11 lb of sand | kg | 4.99 | 11
    dose 45 l | L | 45 |
    dose 20 m³ | L | 20000 | 20
    dose 20 litres per hectare over 3 ha | L/ha | 20 | 3
    dose 5 litres a minute | L/min | 5 |
    dose 3.2 kg/s | kg/min | 192 | 3.2
    clear 20000 m² | ha | 2 | 20000
    wait two hours | min | 120 | 2
    wait 1 h 30 min | min | 90 |
    drive at 5 m/s | km/h | 18 | 5
    drive 800 m | km | 0.8 | 800
    drive 800 | km | 800 | 0.8
    alarm from 24 V and 10 A | V | 24 | 10
    alarm from 24 V and 10 A | A | 10 | 24
    alarm at 400 ppm | % | 0.04 | 400
    alarm at 10 % LEL | % | 10 |
    spin at 50 Hz | rpm | 3000 | 50
    push with 5 kN | kN | 5 |
    push with 5 kN | kn | | 5
    turn to 65 degrees | deg | 65 |
    heat it to 65 degrees Celsius | deg | | 65
    turn 90 degrees a minute later | deg | 90 |
    hold 20 m³ | m | | 20
    alarm at 700 NTU | NTU | 700 |
    go round it twice | count | 2 |
    go round it once | | 1 |
    read the gauge of P-101, alarm at 6 bar | bar | 6 | 101
    pump 11-P-101A, E-204 and TK7, pump-3, 4 rounds | | 4 | 11 101 204 7 3
    wait for30 minutes, radius15 | m | 15 |
"""


def rows() -> list[list[str]]:
    return [[part.strip() for part in line.split("|")] for line in SAID.strip().splitlines()]


@pytest.mark.parametrize(("text", "unit", "right", "wrong"), rows())
def test_the_value_in_the_parameters_own_unit_is_said(
    text: str, unit: str, right: str, wrong: str
) -> None:
    facts, parameter = read(text), Parameter("value", "number", unit or None)
    for value in right.split():
        assert facts.evidence(float(value), parameter).given, value
    for value in wrong.split():
        assert facts.evidence(float(value), parameter).given is False, value


def test_what_is_converted_is_told_from_what_is_said() -> None:
    kelvin, bar = Parameter("heat", "number", "K"), Parameter("pressure", "number", "bar")
    facts = read("Warn at 76.85 °C or 7 bar.")
    assert facts.evidence(350, kelvin).kind == "converted"
    assert facts.evidence(7, bar).kind == "stated"


def test_a_unit_that_nobody_knows_is_told_and_converts_to_none() -> None:
    assert named("Celsius degrees") is None and named("L/ha") is not None
    assert converted(7, "bar", "kPa") == pytest.approx(700)
    assert converted(1, "NTU", "NTU") == 1
    assert converted(1, "NTU", "m") is converted(1, "kg", "m") is None
