"""Sentence frames: how a speaker wraps what is to be done, and how one thing is joined to the next."""

from __future__ import annotations

IMPERATIVE_FRAMES = (
    *("{}",) * 80, *("please {}",) * 9, "can you {}?", "could you {}?", "could you please {}?", "would you please {}?", "can you please {}?",
    "will you {}?", "I want you to {}", "I need you to {}",
    "I'd like you to {}", "we need you to {}", "we want you to {}", "you are to {}", "you're to {}", "go ahead and {}", "have the boat {}",
    "let her {}", "have her {}", "get the boat to {}",
    "the boat should {}", "the boat is to {}", "just {}", "now {}", "{}, please", "your job is to {}", "your task: {}", "it's time to {}",
    "the plan is to {}", "what I want you to do is {}",
    "can we {}?", "could we {}?", "the harbour master wants you to {}", "control wants you to {}", "control says to {}",
    "the office asked us to {}", "the skipper says to {}",
    "control asks that you {}", "the client wants the boat to {}", "they want us to {}", "we've been asked to {}",
    "you should {}", "you need to {}", 
    "make sure you {}", "I'm asking you to {}", "any chance you could {}?",
    "do me a favour and {}", "mission for today: {}", "orders: {}",
    "the mission is to {}", "the idea is to {}", "the captain would like you to {}", "the survey team wants you to {}", "tell the boat to {}",
    "next job: {}", "new job: {}", "new task, {}",
    "we'd be glad if you could {}", "when you get a moment, {}", "right, {}", "ok, {}", "alright, {}", "so {}", 
    
)  # fmt: skip
NOUN_FRAMES = (
    "I need {}", "I'd like {}", "we need {}", "we'd like {}", "give me {}", "give us {}", "{}, please", "can I have {}?", "could we get {}?",
    "could I get {}?", "please do {}", "get me {}", "we want {}",
    "what I need is {}", "what we want is {}", "on the list for today: {}", "today's job: {}", "job: {}", "task: {}", "request {}",
    "requesting {}", "the client wants {}", "control wants {}",
    "the survey team is asking for {}", "the office needs {}", "{} required", "{} wanted", "{} would be great", "how about {}?",
    "any chance of {}?", "please arrange {}", 
    "the plan: {}", "{}", "{}", "{}", "{}", "next up is {}", "we're looking for {}", "they have asked for {}", "can you do {}?",
    "could you manage {}?", "I want {}",
)  # fmt: skip
GERUND_FRAMES = (
    "would you mind {}?", "how about {}?", "start by {}", "your job today is {}", "the plan is {}",
    "the first thing is {}", "today's work is {}",
)  # fmt: skip

NEXT = (
    "then {}", "then {}", "then {}", "after that {}", "after that, {}", "next, {}", "next {}", "once that's done, {}", "when that's done, {}",
    "when you're done, {}", "once you're done {}", "afterwards {}", "afterwards, {}",
    "and then {}", "and after that, {}", "with that done, {}", "following that, {}", "from there, {}", "subsequently {}", "when finished, {}",
    "and {}", "also {}", "{} after that", "{} afterwards", "{} next", "once finished, {}", "as soon as that's done, {}",
    "that done, {}", "then please {}", "after that please {}", "then can you {}?", "then I want you to {}", "after that I'd like you to {}",
    "then you can {}", "on completion {}", "upon completion, {}", "{} when you're through", "and when you're finished, {}",
    "then, {}", "{}", "{}", "{}", "{}",
)  # fmt: skip
NEXT_NOUN = (
    "then {}",
    "after that {}",
    "followed by {}",
    "next {}",
    "and after that {}",
    "then I need {}",
    "after that we'd like {}",
    "then give me {}",
    "{} after that",
    "plus {} afterwards",
    "and finally {}",
    "{}",
)
LAST = (
    "finally, {}",
    "finally {}",
    "lastly, {}",
    "last of all {}",
    "to finish, {}",
    "and last, {}",
    "to wrap up, {}",
    "at the end, {}",
    "to end with, {}",
    "and finally {}",
)
FIRST = (
    "first, {}",
    "first {}",
    "first of all, {}",
    "to begin with, {}",
    "to start, {}",
    "firstly, {}",
)

BUT_FIRST = (
    "{late}, but first {early}", "{late}, but {early} first", "{late} but before that {early}",
    "{late}. Before that, {early}", "{late}. But first {early}", 
    "{late}. Before you do that, {early}", "{late}; before that, {early}", "{late}. Oh, and before that, {early}", "{late} - but first {early}",
    "{late}. Beforehand, {early}", "{late}, though first {early}",
    "{late}. {early_cap} before that", "{late}. First, though, {early}", 
    "{late}. Prior to that, {early}", 
    "before you {late}, {early}", "before you {late} {early}", "{early} before you {late}", "before you {late}, please {early}",
    "{early}, and only then {late}",
    "make sure to {early} before you {late}", "first {early}, then {late}", "{early}. Only after that {late}", "{late}, but not before you {early}",
)  # fmt: skip
AFTER_GERUND = (
    "after {early}, {late}", "{late} after {early}", "once you're done {early}, {late}", "when you're finished {early}, {late}",
    "{late} once you've finished {early}", "start by {early}, then {late}", "begin with {early}, then {late}",
    "{late} when you are done {early}", "after {early} {late}", "having finished {early}, {late}", "as soon as you're through {early}, {late}",
    "{late} as soon as you are done {early}", "following {early}, {late}",
)  # fmt: skip
BEFORE_GERUND = (
    "before {late}, {early}",
    "{early} before {late}",
    "prior to {late}, {early}",
    "ahead of {late}, {early}",
    "{early} prior to {late}",
    "before {late} {early}",
)
AFTER_NOUN = (
    "after {early}, {late}",
    "{late} after {early}",
    "{early} first, then {late}",
    "once {early} is done, {late}",
    "when {early} is finished, {late}",
    "as soon as {early} is finished, {late}",
    "with {early} done, {late}",
    "{late}, but only after {early}",
)

TWO = (
    "{} and {}",
    "{} and then {}",
    "{}, then {}",
    "{} then {}",
    "{}, and then {}",
    "{}, and {}",
    "{}, after that {}",
    "{}, and after that {}",
    "{} and afterwards {}",
    "{}; then {}",
    "{}, and once that's done {}",
)
MANY = (", ", ", then ", ", ", "; ", " and then ", ", and then ", ", after that ", ", next ", " then ")
LAST_JOINT = (" and ", ", and ", ", then ", " and then ", ", and then ", ", and finally ", " and finally ", ", after that ", ", and last ")

STATIONS = (
    "control",
    "harbour control",
    "base",
    "pilot station",
    "ops",
    "the bridge",
    "coastguard",
    "port control",
    "shore",
    "operations",
    "mother ship",
    "station",
    "watch officer",
    "VTS",
    "dispatch",
)
RADIO = (
    "{boat}, this is {station}, {text}, over", "{boat}, {station}. {text}. Over", "{boat}, {station}: {text}. Over",
    "{boat} {boat}, this is {station}. {text}. How copy? Over", "{station} to {boat}, {text}, over",
    "{station} to {boat}: {text}. Acknowledge", "{boat}, {text}. Out", "{boat} from {station}, {text}, over",
    "{station} calling {boat}. {text}. Over and out", "{boat}, message from {station}: {text}. Break. Nothing further. Out",
    "All right {boat}, {text}, over", "{boat}, {station}, task follows: {text}. Over", "{boat}, this is {station}. {text}. Roger so far? Over",
    "{boat}, read back: {text}. Over",
)  # fmt: skip

INTROS_INDEFINITE = (
    "there's {}", "there is {}", "we've got {}", "we have {}", "I've got {}", "there should be {}", "you'll find {}", "the client has {}",
    "we have here {}", "somebody reported {}", "they reported {}", "there is supposed to be {}", "I can see {}",
)  # fmt: skip
INTROS_DEFINITE = (
    "this is about {}",
    "it's about {}",
    "your target is {}",
    "the target is {}",
    "today's target: {}",
    "next on the list is {}",
    "we're worried about {}",
    "the office is asking about {}",
    "I have a job for you at {}",
    "you know {}",
    "remember {}?",
)
WHERE_FIRST = (
    "at {}, {}",
    "at {} {}",
    "beside {}, {}",
    "over at {}, {}",
    "next to {}, {}",
    "when you get to {}, {}",
    "once you're at {}, {}",
    "on arrival at {}, {}",
    "by {}, {}",
    "near {}, {}",
    "close to {}, {}",
    "at {}: {}",
    "off {}, {}",
)
COLON_FIRST = ("{}: {}", "{} - {}", "{}. {}", "target {}: {}", "re {}: {}", "about {}: {}", "for {}: {}", "{}, {}")

PURPOSES = (
    "for the insurance people, {}", "for the handover, {}", "so the divers can start, {}", "to help the dredging crew, {}",
    "for tonight's log, {}", "for the client, {}", "before the tide turns, {}", "while the weather holds, {}", "so we know where we stand, {}",
    "because the owner is asking, {}", "since you're out there anyway, {}", "now that the fog has lifted, {}", "as the ferry has left, {}",
    "for the engineers, {}", "for the record, {}", "as agreed yesterday, {}", "for the harbour board, {}", "to settle an argument, {}",
    "for the monthly check, {}", "as the wind has dropped, {}", "for the research team, {}", "to keep the port authority happy, {}",
    "given the low sun, {}", "for the night shift, {}", "as part of the trial, {}", "for the owner's peace of mind, {}",
)  # fmt: skip
QUESTIONS = (
    "Confirm you have understood", "Is that clear?", "Can you do that?", "Please confirm", "Acknowledge", "Copy?", "All clear?",
    "Let me know if you can't", "Tell me if anything's unclear", "Got that?", "Understood?", "Can you manage?",
)  # fmt: skip
HEADINGS = (
    "job {n}: {text}", "ref {n}: {text}", "{n}: {text}", "ticket {n}. {text}", "request {n}: {text}", "day {n}: {text}",
    "item {n} on the list: {text}", "log {n}: {text}",
    "run {n}, {text}", "order no. {n}: {text}", "[{n}] {text}", "message {n}: {text}", "exercise {n}: {text}", "shift note {n}: {text}",
)  # fmt: skip
LETTERS = (
    ("hi {name}", "{bye}, {me}"), ("hello {name}", "{bye}, {me}"), ("dear {name}", "{bye}, {me}"), ("{name}", "{me}"), ("hi all", "{bye}, {me}"),
    ("morning {name}", "{bye}"),
    ("hey {name}", "{me}"), ("good evening {name}", "{bye}, {me}"), ("dear colleagues", "{bye}, {me}"), ("hi team", "{bye} from {me}"),
    ("to whoever is on watch", "{bye}, {me}"),
)  # fmt: skip
BYES = (
    "regards",
    "best regards",
    "thanks",
    "cheers",
    "many thanks",
    "best",
    "yours",
    "kind regards",
    "greetings",
    "thank you",
    "all the best",
    "best wishes",
    "see you tomorrow",
)
RULED_OUT_FIRST = (
    "don't {wrong}, {right}", "no need to {wrong}, {right} instead", "don't {wrong} but {right}", "I don't want you to {wrong}, just {right}",
    "you don't have to {wrong}, {right} instead",
    "rather than {ger}, {right}", "instead of {ger}, {right}", "{right} instead of {ger}", "{right}, but don't {wrong}",
    "{right} rather than {ger}", "forget {ger}, {right}",
)  # fmt: skip
ON_SITE = (
    "you're already at {}", "you are at {} now", "you're lying at {} already", "she's already at {}", "the boat is lying beside {}",
    "as you're at {} already,", "now that you're at {},", "while you are at {},", "since you're sitting right next to {},",
    "you've just arrived at {}",
    "the boat is at {} as we speak", "as the boat already lies at {},", "you should be alongside {} by now", "we have you right next to {}",
    "from where you are, at {},", "you're there already, at {}", "I can see you're beside {}", "being at {} anyway,",
)  # fmt: skip
