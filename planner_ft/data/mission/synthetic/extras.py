"""What stands around an order: exclusions, limits, small talk, openers and closers, and commands
with no order in them.
"""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from planner_ft.data.mission.synthetic import frames, lexicon
from planner_ft.data.mission.synthetic.numbers import Style, say_length
from planner_ft.data.mission.synthetic.positions import draw_position, position_words, say_position

RULED_OUT = {
    "Diagnostics": (
        ("the diagnostics", "the sensor check", "the self-test", "the health check"),
        "Diagnostics are not run.",
    ),
    "AutoGenerateReportSummary": (
        ("the report", "the write-up", "the summary", "the paperwork"),
        "No report is written.",
    ),
    "SmartDataHarvest": (
        ("the upload", "the data transfer", "uploading anything", "sending anything"),
        "No data are uploaded.",
    ),
    "HorizontalPanorama": (
        ("the panorama", "the all-round pictures", "the pano"),
        "No panorama is taken.",
    ),
    "PerformOrbit": (("the orbit", "the circling", "the lap", "circling"), "No orbit is made."),
    "ThermalTimeLapse": (
        ("the thermal time-lapse", "the thermal readings", "the thermal series"),
        "No thermal readings are taken.",
    ),
    "ThermalHotspotLocalizer": (
        ("the hotspot scan", "the hot spot search"),
        "No hotspot scan is made.",
    ),
    "FeatureStare": (("the video", "the filming", "the steady footage"), "No video is recorded."),
    "BathymetryGridSurvey": (
        ("the depth survey", "the soundings", "the bathymetry"),
        "No depth survey is made.",
    ),
    "DriftAudit": (("the drift", "the drift log", "the drift test"), "No drift is logged."),
    "ParallelStructurePass": (
        ("the pass", "the run along the side", "the wall run"),
        "No pass is made.",
    ),
    "BoatLandingClearanceSweep": (
        ("the boat landing scan", "the landing sweep"),
        "The boat landing is not scanned.",
    ),
    "DockingApproach": (
        ("the docking", "going alongside", "the berthing"),
        "The vehicle does not dock.",
    ),
    "SurveyTarget": (("the inspection", "the survey"), "No survey is made."),
    "KeepStation": (
        ("the station keeping", "the waiting", "the hold"),
        "The vehicle does not hold position.",
    ),
}
HAZARDS = (
    ("divers are down at {place}", "Divers are in the water at {position}."),
    ("there are divers in the water at {place}", "Divers are in the water at {position}."),
    ("keep clear of the net at {place}", "Keep clear of the net at {position}."),
    ("mind the rock at {place}", "Mind the rock at {position}."),
    ("stay away from {place}", "Stay away from {position}."),
    ("there is a wreck at {place}, mind it", "Mind the wreck at {position}."),
    ("avoid the shoal at {place}", "Avoid the shoal at {position}."),
    (
        "the dredger works at {place}, keep away from it",
        "Keep away from the dredger at {position}.",
    ),
    ("don't go near {place}", "Do not go near {position}."),
    ("watch out for the mooring at {place}", "Watch out for the mooring at {position}."),
    (
        "a crane barge is anchored at {place}, give it room",
        "Keep clear of the crane barge at {position}.",
    ),
    ("the swimmers are at {place}", "Swimmers are in the water at {position}."),
    ("leave {place} alone", "Stay away from {position}."),
    ("the ferry passes {place}, let it by", "Let the ferry pass at {position}."),
)
EXCLUSIONS = (
    "{} was done already",
    "{} has been done already",
    "we did {} this morning",
    "the night shift did {} yesterday",
    "skip {}",
    "no need for {}",
    "leave out {}",
    "forget about {}",
    "don't bother with {}",
    "we don't need {}",
    "without {} this time",
    "{} isn't needed",
    "you can skip {}",
    "never mind {}",
    "not {} today",
    "drop {}",
    "{} can wait",
    "cancel {}",
    "{} is off",
    "negative on {}",
    "leave {} for another day",
    "skip {}, that was done already",
    "{} is not required",
    "we can do without {}",
    "no time for {}",
    "and please skip {}",
    "forget {}",
)
RETURN_EXCLUSIONS = (
    "don't come home yet",
    "no need to come home",
    "don't return to base",
    "you don't have to come back",
)


@dataclass(frozen=True)
class Extra:
    """A clause that adds no task, with the constraint that the plan holds for it."""

    text: str
    constraint: str


def exclusion(rng: Random, planned: set[str], *, home: bool) -> Extra | None:
    """Something ruled out that the plan has not in it anyway; None where nothing suits."""
    if not home and rng.random() < 0.06:
        return Extra(rng.choice(RETURN_EXCLUSIONS), "The vehicle does not return home.")
    usual = ("Diagnostics", "AutoGenerateReportSummary", "SmartDataHarvest")
    pool = [
        title
        for title in (usual if rng.random() < 0.6 else tuple(RULED_OUT))
        if title not in planned
    ]
    if "FeatureStare" in pool and planned & {
        "GlareFreeApproach",
        "HorizontalPanorama",
        "PerformOrbit",
    }:
        pool.remove("FeatureStare")
    if not pool:
        return None
    things, constraint = RULED_OUT[rng.choice(pool)]
    thing = rng.choice(things)
    return Extra(rng.choice(EXCLUSIONS).replace("{}", thing), constraint)


LEFT_OUT = (
    "leave the {} out of it",
    "skip the {}",
    "ignore the {}",
    "not the {}",
    "the {} is not part of this",
    "leave the {} for another day",
    "forget about the {}",
    "never mind the {}",
    "the {} can wait",
    "don't bother with the {}",
    "leave the {} alone",
)
TIMES = (
    "14:00",
    "noon",
    "sunset",
    "dark",
    "1630",
    "three o'clock",
    "high water",
    "the tide turns",
    "the ferry comes in",
    "the end of the shift",
    "five",
    "09:45",
    "the fog comes in",
    "the crew change",
    "dawn",
    "tonight",
)
CONDITIONS = (
    "the wind stays down",
    "the visibility holds",
    "the swell stays under a metre",
    "the battery allows it",
    "the channel is clear",
    "nobody is in the water",
    "it stays dry",
    "the light is good enough",
    "the traffic allows it",
    "the link is up",
)


def left_out(rng: Random, description: str) -> Extra:
    """A thing that the command says to leave out."""
    return Extra(rng.choice(LEFT_OUT).format(description), f"The {description} is left out.")


def deadline(rng: Random) -> Extra:
    """A time by which it must be done, or a condition for it."""
    if rng.random() < 0.5:
        word, time = rng.choice(("by", "before")), rng.choice(TIMES)
        if word == "by" and " " in time and time.split(" ")[-1] in ("turns", "in"):
            word = "before"
        text = rng.choice(
            (
                "be done {}",
                "all of it {}",
                "it has to be finished {}",
                "have it done {}",
                "this must be done {}",
                "we need it {}",
            )
        ).format(f"{word} {time}")
        return Extra(text, f"The mission must be finished {word} {time}.")
    condition = rng.choice(CONDITIONS)
    return Extra(
        rng.choice(
            (
                "only if {}",
                "as long as {}",
                "provided {}",
                "if {}",
                "but only while {}",
                "given that {}",
            )
        ).format(condition),
        f"The mission is carried out only if {condition}.",
    )


def no_thing(rng: Random, planned: set[str]) -> Extra | None:
    """A short exclusion: "no report", "no panorama"."""
    pool = [
        title
        for title in (
            "Diagnostics",
            "AutoGenerateReportSummary",
            "SmartDataHarvest",
            "HorizontalPanorama",
            "PerformOrbit",
        )
        if title not in planned
    ]
    if not pool:
        return None
    things, constraint = RULED_OUT[rng.choice(pool)]
    thing = rng.choice([thing for thing in things if thing.startswith("the ")]).removeprefix("the ")
    return Extra(
        rng.choice(
            (
                f"no {thing}",
                f"no {thing} this time",
                f"no {thing} please",
                f"no {thing} needed",
                f"no {thing} required",
            )
        ),
        constraint,
    )


def limit(rng: Random, style: Style) -> Extra:
    """A limit that the operator sets."""
    if rng.random() < 0.16:
        value = say_length(rng, style, 10, 200).text
        text, constraint = rng.choice(lexicon.OPERATOR_LIMITS_VALUED)
        return Extra(text.replace("{value}", value), constraint.replace("{value}", value))
    return Extra(*rng.choice(lexicon.OPERATOR_LIMITS))


def hazard(rng: Random, style: Style) -> Extra:
    """Something to keep away from, with its position, which is no place to go to."""
    position = draw_position(rng)
    text, constraint = rng.choice(HAZARDS)
    return Extra(
        text.format(place=say_position(position, rng, style)),
        constraint.format(position=position_words(position)),
    )


def impossible(rng: Random) -> Extra:
    """A request that no task of the vehicle can meet, with the reason."""
    return Extra(*rng.choice(lexicon.IMPOSSIBLE_REQUESTS))


NOTHING = "The command asks for nothing that the vehicle has a task for."
CANCELLED = "The command rules out everything, so no task is left."
IDLE_TALK = (
    "how are you doing out there?",
    "what's the weather like?",
    "who is on watch tonight?",
    "did you see the game?",
    "is anybody there?",
    "when is lunch?",
    "are you awake?",
    "nice work yesterday",
    "good job with the buoy last week",
    "thanks for everything",
    "hello?",
    "what time is it?",
    "never mind, wrong channel",
    "sorry, wrong boat",
    "ignore my last message",
    "say hello to the crew",
    "how deep is the sea?",
    "who painted you?",
    "do you like boats?",
    "what's for dinner?",
    "I'll call you back in a minute",
    "we'll send orders later",
    "nothing for you at the moment",
    "that was all for today",
    "no orders today",
    "there's nothing to do right now",
    "the mission is postponed until Thursday",
    "we are still waiting for the permit",
    "can you believe this rain?",
    "do you copy?",
    "you're breaking up",
    "happy birthday",
    "see you at the barbecue",
    "was that you on the radar?",
    "somebody left the gate open",
    "what do you think of the new crane?",
    "I wonder who won the regatta",
    "have a nice weekend",
    "the permit is not there yet",
    "do you remember the old ferry?",
)
CANCEL = (
    "cancel everything",
    "forget it",
    "never mind",
    "scrub the mission",
    "the whole thing is off",
    "we're not doing anything today",
    "all jobs are cancelled",
    "do nothing for now",
    "disregard all orders",
    "call the whole thing off",
    "belay all that",
    "no jobs today",
)


def empty_command(rng: Random) -> tuple[list[str], list[str], str]:
    """Sentences of a command that leads to no task, the constraints that say why, and its kind."""
    roll = rng.random()
    if roll < 0.64:
        wishes = [impossible(rng) for _ in range(rng.choices((1, 2, 3), (70, 24, 6))[0])]
        wishes = list(dict.fromkeys(wishes))
        text = (
            " and ".join(wish.text for wish in wishes)
            if len(wishes) < 3
            else f"{wishes[0].text}, {wishes[1].text} and {wishes[2].text}"
        )
        return (
            [rng.choice(frames.IMPERATIVE_FRAMES).replace("{}", text)],
            list(dict.fromkeys(wish.constraint for wish in wishes)),
            "impossible",
        )
    if roll < 0.82:
        sentences = [rng.choice(IDLE_TALK)] if rng.random() < 0.6 else []
        sentences += [
            sentence.rstrip(".")
            for sentence in rng.sample(
                lexicon.SMALL_TALK, rng.choice((0, 1, 1, 2)) if sentences else rng.choice((1, 2, 3))
            )
        ]
        return sentences, [NOTHING], "chatter"
    titles: set[str] = set()
    drawn: list[Extra] = []
    for _ in range(rng.choice((1, 2, 3))):
        extra = exclusion(rng, titles, home=True)
        if extra is not None and extra.constraint not in {other.constraint for other in drawn}:
            drawn.append(extra)
    if rng.random() < 0.6:
        return (
            [rng.choice(CANCEL), *(extra.text for extra in drawn[: rng.choice((0, 1))])],
            [CANCELLED],
            "cancelled",
        )
    return (
        [", ".join(extra.text for extra in drawn)],
        [*dict.fromkeys(extra.constraint for extra in drawn), CANCELLED],
        "ruled-out",
    )
