"""A parameter has the value that a text says, in the parameter's own unit, and no other figure."""

from __future__ import annotations

import pytest

from planner_ft.facts import read
from planner_ft.facts.units import base_of, converted, in_base_units, named, unit_at
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
    treat it with 20 mJ/cm² | J/m² | 200 | 20
    treat it with 20 mJ/cm^2 | J/m² | 200 | 20
    heat it with 3 MJ | kJ | 3000 | 3
    clear 40 mm² | cm² | 0.4 | 40
    leave 40 µm | mm | 0.04 | 40
    leave 40 microns | mm | 0.04 | 40
    leave 2 nm | km | 3.704 | 2
    check the 5 Ω | kΩ | 0.005 |
    spray 5 gpa | L/ha | 46.77 | 5
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


@pytest.mark.parametrize(
    ("name", "base", "factor"),
    [
        ("m", "m", 1),
        ("km", "m", 1000),
        ("rightangle", "deg", 90),
        (" kPa ", "Pa", 1000),
        ("KILOPASCALS", "Pa", 1000),
        ("kilo", "kg", 1),
        ("kilos", "kg", 1),
        ("mW", "W", 0.001),
        ("MW", "W", 1e6),
        ("Mw", None, None),
        ("rpm", "Hz", 1 / 60),
        ("L/min", "m3/s", 0.001 / 60),
        ("litres per hectare", "m3/m2", 1e-7),
        ("kg a minute", "kg/s", 1 / 60),
        ("kg/NTU", None, None),
        ("NTU/s", None, None),
        ("", None, None),
        (None, None, None),
    ],
)
def test_units_by_name(name: str | None, base: str | None, factor: float | None) -> None:
    unit = named(name)
    assert (unit and unit.base) == base
    assert unit is None or unit.factor == pytest.approx(factor)
    assert base_of(name) == (base if unit else name)


def test_what_is_counted_has_no_base() -> None:
    assert named("laps") is not None and base_of("laps") is None


@pytest.mark.parametrize(
    ("value", "unit", "other", "expected"),
    [
        (212, "°F", "°C", 100),
        (100, "°C", "°F", 212),
        (0, "K", "°C", -273.15),
        (7, "bar", "psi", 101.526),
        (5, "m", "m", 5),
        (5, None, None, 5),
        (5, None, "m", None),
        (5, "m", "s", None),
        (3, "L/min", "m3/h", 0.18),
        (1, "hl", "L", 100),
        (1, "hectolitre", "m3", 0.1),
    ],
)
def test_conversions(
    value: float, unit: str | None, other: str | None, expected: float | None
) -> None:
    found = converted(value, unit, other)
    assert found == (expected if expected is None else pytest.approx(expected, rel=1e-5))


def test_values_in_base_units_are_those_of_parameters_with_another_unit() -> None:
    known = {name: Parameter(name, "number", name) for name in ("m", "km", "°C", "K", "NTU")}
    values = {"m": 5, "km": 2, "°C": 4, "K": 273.15, "NTU": 9, "h": 3}
    assert in_base_units(values, known) == [2000, 0]
    assert in_base_units({"km": "2"}, known) == []


@pytest.mark.parametrize(
    ("text", "letters", "base", "words"),
    [
        ("kPa", False, "Pa", "kPa"),
        ("kpascal", False, None, ""),
        ("Kilopascals high", False, "Pa", "Kilopascals"),
        ("V", True, "V", "V"),
        ("V", False, None, ""),
        ("Va", True, None, ""),
        ("°", True, None, ""),
        ("°C", False, "degC", "°C"),
        ("L/ha", False, "m3/m2", "L/ha"),
        ("L per ha", False, "m3/m2", "L per ha"),
        ("L / min", False, "m3/s", "L / min"),
        ("litres a minute", False, "m3/s", "litres a minute"),
        ("m/s", False, None, ""),
        ("km per hour", False, None, ""),
        ("s per litre", False, None, ""),
        ("degrees per second", False, "deg/s", "degrees per second"),
        ("degrees a minute later", False, None, ""),
        ("% an hour", False, None, ""),
        ("% per hour", False, "%/s", "% per hour"),
        ("laps", False, None, ""),
    ],
)
def test_the_unit_at_a_place_of_a_text(
    text: str, letters: bool, base: str | None, words: str
) -> None:
    found = unit_at(f"5 {text}", 2, letters=letters)
    assert (found[0].base, text[: found[1] - 2]) == (base, words) if base else found is None
