"""The end of `make demo`: one table, one figure, three sentences on what was seen.

python scripts/demo.py build/demo                      # shows them, writes demo.md, demo.png and demo.svg there
python scripts/demo.py build/demo --into README.md     # and puts table and sentences between the marks of that file
"""

import argparse
from pathlib import Path

from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.folder import read_results
from planner_ft.benchmark.results import Results, Row
from planner_ft.report.charts import Chart, cell
from planner_ft.report.pictures import picture
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import atomic_writer, read_json, read_text, write_text
from planner_ft.support.resources import clock
from planner_ft.support.tables import Table, TableRow, markdown_table, row

COLUMNS = ("f1", "strict_valid", "exact_sequence", "parameters", "whole_plan")
DRAWN = {"f1": "F1", "exact_sequence": "exact sequences", "whole_plan": "whole plans right"}
BEGIN, END = "<!-- make demo: begin -->", "<!-- make demo: end -->"


def section(title: str, results: Results) -> list[TableRow]:
    named = f"{title}, {results.data['n']} commands"
    lines = [row(one.heading, *one.cells(COLUMNS)) for one in results.rows]
    return [row(named, kind="section"), *lines]


def chart(drone: Results, surface: Results) -> Chart:
    """A bar per system and metric."""
    shown = [("drone", one) for one in drone.rows] + [("boat", one) for one in surface.rows]
    rows, groups = [], []
    for vehicle, one in shown:
        for name, words in DRAWN.items():
            found = one.figure(name)
            bar = cell(found.value, found.low, found.high), cell(None)
            rows.append(row(f"{vehicle}, {one.heading}: {words}", *bar))
            groups.append(words)
    title = "A new vehicle, and the one that the base knows"
    table = Table("System", ("share, with 95 % intervals", ""), rows, name="demo", title=title)
    return Chart("bars", table, groups=tuple(groups))


def figures(one: Row) -> str:
    f1 = one.figure("f1").value or 0
    names = ("strict_valid", "exact_sequence", "whole_plan")
    valid, exact, whole = (round(100 * (one.figure(name).value or 0)) for name in names)
    return f"F1 {f1:.2f} ({valid} % strictly valid, {exact} % exact, {whole} % whole plans right)"


def verdict(results: Results, first: str, second: str, metric: str) -> str:
    """What the comparison says of the second configuration."""
    for one in results.contrasts["configuration"]:
        ends = one.first.split()[-1], one.second.split()[-1], one.metric
        if ends == (first, second, metric):
            chance = one.verdict in ("better", "worse")
            return f"{one.verdict} beyond chance" if chance else f"{one.verdict} (95 %)"
    return "not compared"


def sentences(drone: Results, surface: Results, trained: dict, commands: int) -> list[str]:
    rows = {one.configuration: one for one in drone.rows}
    seconds, copies = trained["result"]["seconds"], trained["samples"]["training"] - commands
    return [
        "Shown the drone's tasks in its prompt alone, the base reaches"
        f" {figures(rows['base'])}, held to the schema {figures(rows['base+schema'])}; an"
        f" adapter trained on {commands} commands, and {copies} copies and borrowed ones, in"
        f" {clock(seconds)} minutes reaches"
        f" {figures(rows['lora'])}, by F1 {verdict(drone, 'base', 'lora', 'f1')}.",
        "With the facts of the command enforced the same adapter reaches"
        f" {figures(rows['lora+grounded'])}, by whole plans"
        f" {verdict(drone, 'lora', 'lora+grounded', 'whole_plan')}.",
        f"The surface vehicle's planner as it ships reaches {figures(surface.rows[0])} on its first"
        f" {surface.data['n']} challenge commands; a person reads every plan before it is carried"
        " out.",
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path, help="where make demo wrote its benchmarks")
    parser.add_argument("--into", type=Path, help=f"file with {BEGIN} and {END}")
    arguments = parser.parse_args()
    out = arguments.folder
    drone, surface = (read_results(out / name)[0] for name in ("drone", "surface"))
    rows = section("Inspection drone, new to the base", drone)
    rows += section("Surface vehicle, as shipped", surface)
    table = Table("", [METRIC[one].title for one in COLUMNS], rows)
    commands = read_text(out / "data" / "drone" / "mission" / "train.jsonl").count("\n")
    said = sentences(drone, surface, read_json(out / "adapter" / "manifest.json"), commands)
    text = "\n".join([markdown_table(table), *(f"- {one}" for one in said)]) + "\n"
    write_text(out / "demo.md", text)
    for suffix, content in picture(chart(drone, surface)).items():
        with atomic_writer(out / f"demo.{suffix}", "wb") as stream:
            stream.write(content)
    if arguments.into:
        before, mark, rest = read_text(arguments.into).partition(BEGIN)
        _old, end, after = rest.partition(END)
        if not (mark and end):
            raise PlannerError(f"{arguments.into}: has no {BEGIN} ... {END}")
        write_text(arguments.into, f"{before}{BEGIN}\n{text}{END}{after}")
    print(f"{text}\n{out}: demo.md, demo.png, demo.svg, and the adapter and benchmarks")


if __name__ == "__main__":
    main()
