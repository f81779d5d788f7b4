"""More sentence frames for one movement: terse notes, clauses in the passive, skills named before
the movement.
"""

from __future__ import annotations

from planner_ft.data.task.movements import Movement
from planner_ft.data.task.phrasebook import Call
from planner_ft.data.task.phrasing import (
    Single,
    Speaker,
    can_with,
    join,
    move_and,
    move_while,
    sentence,
    sentences,
)


def can_passive(calls: list[Call]) -> bool:
    """Whether a clause in the passive can be made of all of the skills."""
    return bool(calls) and all(call.passive_saying is not None for call in calls)


def noun(say: Speaker, call: Call) -> str:
    """The skill as a note: "depth from sounder_a", or as a command where it has no such words."""
    return say.with_words([call]) if call.with_saying else say.call(call)


def notes(say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]) -> str:
    """Hold for 60 s. GPS fix. Depth from sounder_a. Margin of 5 m."""
    calls = perceptions + filters if say.chance(0.6) else filters + perceptions
    roll = say.rng.random()
    if roll < 0.4 or len(calls) < 2:
        parts = [say.move(movement), *(noun(say, call) for call in calls)]
        if say.chance(0.2):
            parts = [*parts[1:], parts[0]]
        return " ".join(sentence(part) for part in parts)
    listed = join([noun(say, call) for call in calls], say.pick(", ", " and ", "; "))
    joint = say.pick(". ", ": ", " - ", "; ", " / ")
    text = f"{say.move(movement)}{joint}"
    return (
        f"{sentence(text.strip(' .'))} {sentence(listed)}"
        if joint == ". "
        else sentence(text + listed)
    )


def in_brackets(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]
) -> str:
    """Hold for 60 s (depth logging, margin of 5 m)."""
    calls = perceptions + filters
    if not calls:
        return move_and(say, movement, filters, perceptions)
    return sentence(
        f"{say.move(movement)}"
        f" ({join([noun(say, call) for call in calls], say.pick(', ', ' and ', '; '))})"
    )


def data_first(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]
) -> str:
    """Depth logging and a GPS fix while holding for 60 s, with the heading locked."""
    if not can_with(perceptions):
        return move_while(say, movement, filters, perceptions)
    text = (
        f"{say.with_words(perceptions)} {say.pick('while', 'while', 'when')}"
        f" {say.move(movement, 'ing')}"
    )
    if not filters:
        return sentence(text)
    return sentence(
        f"{text}, {say.with_words(filters) if can_with(filters) else say.calls(filters, 'ing')}"
    )


def do_this(say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]) -> str:
    """Log the depth and take a GPS fix. Do this while holding for 60 s."""
    calls = perceptions + filters
    if not calls:
        return sentences(say, movement, filters, perceptions)
    head = sentence(say.calls(calls))
    if say.chance(0.6):
        opener = say.pick(
            "do this while",
            "all this while",
            "this is to be done while",
            "you do so while",
            "do it while",
        )
        return f"{head} {sentence(opener + ' ' + say.move(movement, 'ing'))}"
    return (
        f"{head}"
        f" {sentence(say.pick('meanwhile, ', 'while you do, ', 'for the movement: ', 'to do so, ') + say.move(movement))}"
    )


def passive(say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]) -> str:
    """Hold for 60 s. The depth is logged and the heading is to be locked."""
    calls = perceptions + filters
    if not can_passive(calls):
        return move_while(say, movement, filters, perceptions)
    roll = say.rng.random()
    if roll < 0.35:
        return sentence(
            f"while {say.move(movement, 'ing')},"
            f" {join([say.passive(call) for call in calls], ' and ')}"
        )
    if roll < 0.5:
        return sentence(
            f"{join([say.passive(call) for call in calls], ' and ')} while"
            f" {say.move(movement, 'ing')}"
        )
    head = sentence(say.move(movement))
    if roll < 0.7:
        return " ".join([head, *(sentence(say.passive(call)) for call in calls)])
    opener = say.pick("meanwhile ", "throughout, ", "during this, ", "", "", "all the while ")
    return f"{head} {sentence(opener + join([say.passive(call) for call in calls], ' and '))}"


def wanted(say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]) -> str:
    """I want the depth logged while you hold for 60 s."""
    calls = perceptions + filters
    if not can_with(calls):
        return sentences(say, movement, filters, perceptions)
    roll = say.rng.random()
    if roll < 0.5:
        opener = say.pick("I want", "I need", "we need", "we want", "let me have", "please get me")
        return sentence(f"{opener} {say.with_words(calls)} while you {say.move(movement)}")
    opener = say.pick("I want ", "we need ", "what I need: ", "needed: ", "required: ", "add ")
    return f"{sentence(say.move(movement))} {sentence(opener + say.with_words(calls))}"


def colon(say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]) -> str:
    """Hold for 60 s, doing this: log the depth, take a GPS fix."""
    calls = perceptions + filters
    if not calls:
        return sentence(f"{say.pick('just', 'simply', 'only')} {say.move(movement)}")
    joint = say.pick(
        ", and while you do: ",
        "; meanwhile ",
        "; in that time ",
        ", and at the same time ",
        ", and in the meantime ",
        "; as you do so, ",
    )
    return sentence(say.move(movement) + joint + say.calls(calls))


def split_filters(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]
) -> str:
    """With a margin of 5 m, hold for 60 s. Log the depth. Lock the heading."""
    calls = filters + perceptions
    if not calls:
        return move_and(say, movement, filters, perceptions)
    first, *rest = calls
    text = (
        sentence(f"with {say.with_words([first])}, {say.move(movement)}")
        if first.with_saying
        else f"{sentence(say.call(first))} {sentence(say.move(movement))}"
    )
    return " ".join(
        [
            text,
            *(
                sentence(
                    say.passive(call) if call.passive_saying and say.chance(0.3) else say.call(call)
                )
                for call in rest
            ),
        ]
    )


TERSE: tuple[tuple[Single, float], ...] = (
    (notes, 3.5),
    (in_brackets, 0.8),
    (data_first, 1.6),
    (do_this, 1),
    (passive, 2.2),
    (wanted, 1.2),
    (colon, 1),
    (split_filters, 1),
)


def unmoved(say: Speaker, filters: list[Call], perceptions: list[Call]) -> str:
    """A prompt that asks for no movement: "GPS fix, lens check and depth from sounder_a.", "The
    depth is logged.".
    """
    calls = perceptions + filters
    roll = say.rng.random()
    if roll < 0.4 and can_passive(calls):
        return (
            " ".join(sentence(say.passive(call)) for call in calls)
            if say.chance(0.6)
            else sentence(join([say.passive(call) for call in calls], " and "))
        )
    if roll < 0.65:
        return sentence(
            join([noun(say, call) for call in calls], say.pick(", ", " and ", "; ", " + "))
        )
    if roll < 0.8:
        return " ".join(sentence(noun(say, call)) for call in calls)
    where = say.pick(
        " from where you are",
        " without moving",
        " on the spot",
        " here",
        " from the present position",
        "; no movement is needed",
        ", no need to move",
        ", stay where you are",
    )
    return sentence(say.calls(calls) + where)
