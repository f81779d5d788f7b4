"""The task-level data set, sampled from a vocabulary.

    for record in sample_tasks(load_vocabulary(), seed=0, count=500, split="test"): ...

About half of the samples are drawn as a script (movements, filters, perception skills), said in a prompt, and the label
is derived from the script: exactly what the prompt says. The others come from whole-prompt templates (prompts/). A
prompt's skeleton, the prompt without its values, decides which of train, validation and test may hold it, so that the
splits share no sample even when numbers and names are masked; a template belongs to one of them as a whole besides.
"""

from __future__ import annotations

import itertools
import random
import zlib
from collections.abc import Iterator, Sequence
from typing import Any, Literal, get_args

from planner_ft.data.task import phrasing, sequences
from planner_ft.data.task.context import Context
from planner_ft.data.task.movements import Movement, implied_hold, simple
from planner_ft.data.task.noise import noisy
from planner_ft.data.task.outline import outline
from planner_ft.data.task.patterns import EXTRA, main_movement
from planner_ft.data.task.phrasebook import Call, Phrasebook, Saying
from planner_ft.data.task.phrasing import Scoped, Script, Speaker, pick_weighted
from planner_ft.data.task.prompts.binding import Bound
from planner_ft.data.task.prompts.draw import draw_template, pick
from planner_ft.data.task.prompts.library import bound_lines, normal
from planner_ft.data.task.shapes import go_back, home
from planner_ft.data.task.steps import expected_plan
from planner_ft.data.task.template import close_gaps, plain, skeleton
from planner_ft.data.task.terse import TERSE, unmoved
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.definition import Vocabulary
from planner_ft.vocabulary.plans import canonical_parameters, plan_problems

SINGLE = (*phrasing.SINGLE, *TERSE)

Split = Literal["train", "validation", "test", "test_unseen"]
SPLITS: tuple[Split, ...] = get_args(Split)

EXTRA_MOVEMENTS = (0.56, 0.2, 0.13, 0.07, 0.04)  # how often a prompt has that many movements beside the main one
PERCEPTIONS = (0.14, 0.36, 0.28, 0.15, 0.07)
FILTERS = (0.56, 0.34, 0.1)
LONGEST = 24  # steps; longer answers are drawn anew
AGAIN = 0.15  # share of skills that stand a second time with other parameters
SCOPED = 0.5  # share of prompts with several movements that say first these and then what runs in which of them
TEMPLATES = 0.5  # share of the draws that come from a whole-prompt template
HELD_OUT = 6  # percent of the skeletons that belong to validation, and as many to test


def sample_tasks(vocabulary: Vocabulary, seed: int, count: int | None, split: Split) -> Iterator[dict[str, Any]]:
    """Yield `count` different records, or an endless stream when `count` is None; same seed, same records.

    Record: {"id", "family", "task", "parameters", "prompt", "expected"}, canonical and strictly valid. Raises
    PlannerError for an unknown split, or when the vocabulary has not enough different samples.
    """
    if split not in SPLITS:
        raise PlannerError(f"split {split}: must be {', '.join(SPLITS)}")
    rng = random.Random(f"{vocabulary.name}:{seed}:{split}")
    book = Phrasebook(vocabulary, unseen=split == "test_unseen")
    templates = templates_of(book, split)
    seen: set[int] = set()
    misses = 0
    numbers = itertools.count() if count is None else range(count)
    for number in numbers:
        while True:
            from_template = templates and rng.random() < TEMPLATES
            drawn = draw_from_template(templates, book, rng, split) if from_template else draw_sample(book, rng, split)
            key = hash_of(drawn["task"], drawn["parameters"], drawn["prompt"]) if drawn else 0
            if drawn and key not in seen:
                break
            misses += 1
            if misses > 2000 + 200 * (number + 1):
                raise PlannerError(f"vocabulary {vocabulary.name}: split {split} has fewer than {count} different samples; ask for fewer or add phrases")
        seen.add(key)
        yield {"id": f"task-{split}-{number:06d}", **drawn}


def hash_of(*parts: Any) -> int:
    """A stable 64-bit digest of what makes a sample a duplicate."""
    data = repr(parts).encode()
    return zlib.crc32(data) << 32 | zlib.crc32(data[::-1])


def split_of(text: str) -> Split:
    """The split to which a skeleton of a training family belongs."""
    bucket = zlib.crc32(text.lower().encode()) % 100
    return "test" if bucket < HELD_OUT else "validation" if bucket < 2 * HELD_OUT else "train"


def templates_of(book: Phrasebook, split: Split) -> list[tuple[Bound, ...]]:
    """The whole-prompt templates of this split; none for test_unseen."""
    return [bound for source, bound in bound_lines(book) if split_of(normal(source)) == split] if split != "test_unseen" else []


def draw_from_template(templates: Sequence[Sequence[Bound]], book: Phrasebook, rng: random.Random, split: Split) -> dict[str, Any] | None:
    """One record without id from a whole-prompt template, or None when the draw came to nothing or belongs to another split."""
    bound = pick(templates, rng)
    context = Context(book, bound.task, rng)
    drawn = draw_template(bound, context)
    if drawn is None or len(drawn[1]["skill_sequence"]) > LONGEST:
        return None
    text, expected, skills = drawn
    text = close_gaps(aside(Speaker(rng, book), text, skills, context))
    if split_of(f"{bound.task.title} {skeleton(text)}") != split:
        return None
    return record(f"template/{len(expected['skill_sequence'])}", context, plain(noisy(text, rng)), expected)


def record(family: str, context: Context, prompt: str, expected: dict[str, Any]) -> dict[str, Any]:
    """The sample without its id. Raises PlannerError when the plan is not strictly valid."""
    vocabulary = context.book.vocabulary
    problems = plan_problems("task", expected, vocabulary, strict=True)
    if problems:
        raise PlannerError(f"vocabulary {vocabulary.name}: a sample of {context.task.title} is not valid ({problems[0]}); correct the phrase file's ranges")
    parameters = canonical_parameters(context.parameters(), context.task)
    return {"family": family, "task": context.task.title, "parameters": parameters, "prompt": prompt, "expected": expected}


def draw_sample(book: Phrasebook, rng: random.Random, split: Split) -> dict[str, Any] | None:
    """One record without id, or None when the draw came to nothing or belongs to another split."""
    tasks = book.vocabulary.tasks
    task = tasks[int(rng.random() * len(tasks))]
    context = Context(book, task, rng)
    script = draw_script(context)
    if script is None or sum(len(movement.steps) for movement in script.movements) > LONGEST:
        return None
    say = Speaker(rng, book)
    frame, text = say_it(say, script, context)
    groups = [script.filters, script.perceptions, [scoped.call for scoped in script.scoped]]
    groups += [calls for movement in script.movements for calls in (movement.filters, movement.perceptions)]
    said = {call.skill for calls in groups for call in calls}
    text = close_gaps(aside(say, text, {name for name in said if name}, context))
    if split != "test_unseen" and split_of(f"{task.title} {skeleton(text)}") != split:
        return None
    prompt = plain(noisy(text, rng)) if split != "test_unseen" else plain(text)
    family = f"{'unseen-' if split == 'test_unseen' else ''}{frame}/{script.movements[0].kind}{len(script.movements)}"
    return record(family, context, prompt, expected_plan(script, book.vocabulary))


def draw_script(context: Context) -> Script | None:
    """Movements, filters and perception skills of one sample."""
    rng = context.rng
    lead = _lead(context)
    movements = _movements(context, lead)
    if movements is None:
        return None
    script = Script(movements)
    if lead:
        script.perceptions += lead
    perceptions = _draw_calls(context, "perception", _count(rng, PERCEPTIONS), script)
    filters = _draw_calls(context, "filter", _count(rng, FILTERS), script)
    if perceptions and rng.random() < AGAIN / 2 and (again := _another(context, perceptions[-1])):
        perceptions.append(again)
    if movements[0].saying is None and not script.perceptions and not perceptions:
        return None
    scoped = len(movements) > 1 and not context.book.unseen and not lead and rng.random() < SCOPED
    for calls, name in ((perceptions, "perceptions"), (filters, "filters")):
        for call in calls:
            if scoped:
                script.scoped += _scoped(context, call, name, len(movements))
                continue
            if len(movements) > 1 and rng.random() < 0.6:
                getattr(movements[int(rng.random() * len(movements))], name).append(call)
            else:
                getattr(script, name).append(call)
    _at_each(context, script)
    return script


def _scoped(context: Context, call: Call, role: str, count: int) -> list[Scoped]:
    """The skill in some of the steps and, now and then, once more with other parameters in the others: "5 m on the first leg, 10 m on the second"."""
    steps = _steps(count, context.rng)
    others = frozenset(range(count)) - steps
    other = _another(context, call) if others and context.rng.random() < AGAIN else None
    return [Scoped(call, role, steps), *([Scoped(other, role, others)] if other else [])]


def _another(context: Context, call: Call) -> Call | None:
    """The same skill with other parameters."""
    if call.skill is None or not call.parameters or not context.book.skills[call.skill].several:
        return None
    other = context.call(call.skill)
    return other if other.parameters and other.parameters != call.parameters else None


def _steps(count: int, rng: random.Random) -> frozenset[int]:
    """The movements beside which a skill runs: all, one, all but one, or any."""
    roll = rng.random()
    one = frozenset({int(rng.random() * count)})
    if roll < 0.3:
        return frozenset(range(count))
    if roll < 0.75 or count == 2:
        return one
    return frozenset(range(count)) - one if roll < 0.88 else one | {int(rng.random() * count)}


def _at_each(context: Context, script: Script) -> None:
    """Now and then say that a skill runs "at each waypoint", where there is but one movement and it has several."""
    movement = script.movements[0]
    if len(script.movements) > 1 or len(movement.steps) < 3 or movement.kind.endswith("_stops") or movement.saying is None:
        return
    goto = context.book.skills[movement.steps[0][0]].skill.motion == "goto"
    phrases = context.book.sentences.get("each" if goto else "each_turn", [])
    for call in script.perceptions:
        if phrases and call.skill and context.book.skills[call.skill].repeats and context.rng.random() < 0.4:
            call.with_saying = None
            call.saying.suffix = f" {phrases[int(context.rng.random() * len(phrases))]}"


def _count(rng: random.Random, shares: Sequence[float]) -> int:
    roll = rng.random()
    for number, share in enumerate(shares):
        if roll < share:
            return number
        roll -= share
    return 0


def _movements(context: Context, lead: list[Call]) -> list[Movement] | None:
    rng = context.rng
    if (lead and rng.random() < 0.55) or (not lead and rng.random() < (0.35 if context.task.arrival == "none" and context.task.pattern == "hold" else 0.02)):
        held = implied_hold(context)
        return [held] if held else None
    main = simple(context, context.book.motions["hold"]) if lead and rng.random() < 0.7 and "hold" in context.book.motions else main_movement(context)
    movements = [main]
    for _ in range(_count(rng, EXTRA_MOVEMENTS)):
        extra = _extra(context)
        if extra:
            movements.insert(int(rng.random() * (len(movements) + 1)), extra)
    if rng.random() < 0.05 and (last := (home if rng.random() < 0.4 else go_back)(context)):
        movements.append(last)
    return movements


def _extra(context: Context) -> Movement | None:
    rng = context.rng
    roll = rng.random()
    if roll < 0.1:
        return EXTRA[int(rng.random() * len(EXTRA))](context)
    if roll < 0.3 and (goto := context.book.motions.get("goto")):
        return simple(context, goto)
    names = context.task.skills["navigation"] if roll < 0.6 else context.book.by_role["navigation"]
    return simple(context, names[int(rng.random() * len(names))])


def _lead(context: Context) -> list[Call]:
    """The hold in the task's own words ("search for the barge"), with the skill that it asks for."""
    entry, rng = context.entry, context.rng
    if not entry.lead or rng.random() < 0.2:
        return []
    slots = context.slots()
    parameters: dict[str, Any] = {}
    for place, name in entry.links.items():
        if place.startswith("lead."):
            context.require(name)
            value = context.fill(slots, name, place)
            if name == entry.lead_skill.get("from"):
                parameters[entry.lead_skill["parameter"]] = [value]
    templates = [template for template in entry.lead if template.fits(frozenset(slots.given))]
    return [Call(entry.lead_skill.get("skill"), parameters, Saying(templates, slots))] if templates else []


def _draw_calls(context: Context, role: Literal["filter", "perception"], count: int, script: Script) -> list[Call]:
    rng = context.rng
    fitting = context.task.skills.get(role, ())
    every = context.book.by_role[role]
    calls: list[Call] = []
    for _ in range(count):
        names = fitting if fitting and rng.random() < (0.8 if role == "perception" else 0.9) else every
        if not names:
            break
        name = names[int(rng.random() * len(names))]
        again = [call for call in calls if call.skill == name]
        if again and (role == "filter" or rng.random() < 0.7):
            continue
        call = context.call(name)
        if not any(call.parameters == other.parameters or not call.parameters or not other.parameters for other in again):
            calls.append(call)
    return calls


def say_it(say: Speaker, script: Script, context: Context) -> tuple[str, str]:
    """The name of the frame, and the prompt with its values marked."""
    unseen = context.book.unseen
    if script.movements[0].saying is None and len(script.movements) == 1:
        terse = not unseen and all(call.skill for call in script.perceptions) and say.chance(0.5)
        text = (unmoved if terse else phrasing.no_movement)(say, script.filters, script.perceptions)
        if unseen:
            text = f"Here is what is wanted: {text[0].lower()}{text[1:]}" if text[0].isalpha() else text
        return "no_movement", opened(say, text, context)
    if len(script.movements) == 1:
        single = pick_weighted(phrasing.UNSEEN_SINGLE if unseen else SINGLE, say.rng)
        text = single(say, script.movements[0], script.filters, script.perceptions)
        return single.__name__, opened(say, text, context)
    if script.scoped:
        return "outline", opened(say, outline(say, script), context)
    sequence = pick_weighted(sequences.UNSEEN_SEQUENCES if unseen else sequences.SEQUENCES, say.rng)
    return sequence.__name__, opened(say, sequences.say_script(say, script, sequence), context)


def opened(say: Speaker, text: str, context: Context) -> str:
    """The prompt, now and then with polite or official words before it, or with the task's own opener."""
    first_word = text.split(" ", 1)[0].lower()
    if context.book.unseen or first_word not in context.book.verbs or say.chance(0.85):
        return text
    openers = ["please ", "you are to ", "now ", "your task: ", "task: ", "I want you to ", "could you please "]
    if context.entry.openers and say.chance(0.7):
        openers = [f"{opener} " for opener in context.entry.openers]
    opener = say.pick(*openers)
    return phrasing.sentence(opener + text[0].lower() + text[1:])


def aside(say: Speaker, text: str, said: set[str], context: Context) -> str:
    """The prompt, now and then with a sentence that changes nothing: background, a reason, what is not wanted."""
    roll = say.rng.random()
    sentences = context.book.sentences
    if roll < 0.03 and sentences.get("background"):
        remark = context.book.say(say.pick(*sentences["background"]), say.rng)
        return f"{text} {remark}" if say.chance(0.5) else f"{remark} {phrasing.sentence(text)}"
    if roll < 0.05 and sentences.get("reason"):
        return f"{text[:-1]} {context.book.say(say.pick(*sentences['reason']), say.rng)}."
    if roll < 0.075 and sentences.get("nothing"):
        return f"{text} {say.pick(*sentences['nothing'])}"
    if roll < 0.115:
        return _refusal(say, text, said, context)
    if roll < 0.14 and sentences.get("negation"):
        others = [name for name in context.task.skills.get("perception", ()) if name not in said]
        if others:
            templates = context.book.skills[say.pick(*others)].fitting(frozenset())
            refused = templates[int(say.rng.random() * len(templates))].render(context.slots(), say.rng)
            return f"{text} {say.pick(*sentences['negation']).format(refused)}"
    return text


def _refusal(say: Speaker, text: str, said: set[str], context: Context) -> str:
    """The prompt with a remark that a skill which it does not ask for is not wanted: "No recording."."""
    refused = [phrase for name, entry in context.book.skills.items() if name not in said for phrase in entry.none]
    if not refused:
        return text
    phrase = say.pick(*refused)
    if text[-1] != "." or say.chance(0.5):
        return f"{text} {phrasing.sentence(phrase)}"
    return f"{text[:-1]}{say.pick(', ', '; ', ' - ')}{phrase}."
