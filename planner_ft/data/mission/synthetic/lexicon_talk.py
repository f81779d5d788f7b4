"""Talk around a command: openers, closers, fillers, whereabouts and talk that asks for nothing.

Openers and closers stand without the punctuation that joins them on; small talk is whole sentences.
"""

from __future__ import annotations

from planner_ft.data.mission.synthetic.phrases import listed

SMALL_TALK = listed("""
    The coffee machine is broken again.; Lovely light out there this morning.; It rained the whole night.; My tea has gone cold.
    The gulls are loud today.; Somebody left the kettle on.; The boss is in a good mood for a change.; We had a quiet night.
    The radio crackles like mad today.; I could do with a nap.; The new lad starts on Monday.; Ingrid sends her regards.; The wind is finally easing.
    It is freezing in this office.; The forecast looks decent.; Nobody told me about the party.; The football was a disgrace.; My boots are still wet.
    The canteen has run out of soup.; I have not slept much.; The auditors are in the building.; We lost the quiz again.; The dog ate my sandwich.
    The sea looks like oil today.; There is a rainbow over the harbour.; Old Pete would have loved this.; The heating is on the blink.
    My wife thinks I live here.; The minister was here yesterday.; The fog has lifted at last.; It smells of fish in here.
    The schoolchildren waved at us.; I miss the summer.; The printer is jammed.; Everybody is off with a cold.; We are all very proud of you.
    The sun is out for once.; The carpenters are making a racket.; I am new on this desk.; This is my last shift before the holidays.
    The swell has gone down.; It was blowing a gale last night.; You did well yesterday.; The harbour was packed at the weekend.
    The tide tables are late this year.; We celebrated until late.; Somebody ate all the biscuits.; The insurance people are nervous.
    The mayor is very keen on this.; The paint is still wet on the sheds.; My brother used to sail here.; The ferry was late again.
    I forgot my glasses.; The lads are playing cards.; The crane driver is on strike.; Nothing ever happens on a Sunday.
    The phone has been ringing all morning.; The water is as clear as glass.; The jellyfish are back.; It is a bank holiday.
    The bakery by the gate has closed.; The bridge was painted last spring.; That storm was something.; Our intern made cake.
    The union meeting went on for ever.; The northern lights were out.; We had visitors from the ministry.; The cat had kittens in the boathouse.
    The divers have gone for lunch.; The mast lights look pretty.; I burnt my toast.; The owner worries a lot.; The traffic was murder.
    The museum has a new curator.; The seals were singing.; Spring is late.; The lease runs out soon.; The choir practises next door.
    This chair is killing my back.; The old harbour master retired.; The apprentices are keen.; The moon was enormous.; We have run out of milk.
    The windows need cleaning.; Nobody reads the notice board.; My cousin married a pilot.; The barometer is rising.
    I have a dentist's appointment later.; The night was clear and cold.; Half the crew is seasick.; That was a rough week.; The swallows are back.
    The generator hums like a bee.; The lighthouse keeper was a poet.; I never liked Mondays.; The rain gauge overflowed.
    Everyone here is in high spirits.
""")
FILLERS = listed("""
    er; um; uh; well; you know; like; right; so; okay; ok; I mean; let's see; hmm; actually; basically; say; look; listen; kind of; sort of; mate
    if you please; please; if you would; if you can; when you are ready; in your own time; sharpish; nice and easy; carefully; quickly; no rush
    gently; as usual; for me; for us; if possible; just; simply; kindly; now; right away; at once; straight away; pronto; ASAP; as soon as you can
    steady now; there's a good boat
""")
WHEREABOUTS = listed("""
    off the north mole; somewhere near the slipway; upstream of the bridge; downstream of the weir; out past the breakwater; by the old pier
    close to the harbour mouth; in the outer harbour; in the inner basin; near the fuel jetty; behind the breakwater; between the piers
    under the footbridge; off the point; off the headland; on the far side of the bay; somewhere in the bay; at the edge of the fairway
    along the east shore; along the sea wall; near the lighthouse; off the beach; beyond the sandbank; inside the reef; outside the reef; up the creek
    down by the lock; near the mussel rafts; among the moorings; in the mooring field; by the yacht club; close to the ferry route; in the river mouth
    up the fjord; at the head of the fjord; off the island; round the back of the island; near the cliffs; under the cliffs; in the shallows
    over the wreck site; south of the windfarm; on the edge of the windfarm; north of the harbour; east of the channel; to the west of the island
    in the lee of the mole; in the anchorage; off the oil terminal; near the outfall; close inshore; well offshore; just off the rocks
    by the dry dock; opposite the shipyard; across from the fish market; in front of the power station; next to the pump house; near the dam
    halfway to the island; at the end of the canal; in the marina; in the ship canal; by the swing bridge; below the viaduct; above the weir
    off the sailing school; near the salmon farm; out by the cages; near the bathing beach; at the bend of the river; somewhere up north; out to sea
    a bit south of the jetty; off the promontory; near the tanker berth; around the corner from the slip; somewhere off the old fort
    near the ferry slip; in the turning circle; off the coal quay; out on the flats; by the tidal pool; in the sound; on the windward shore
    close to the reed beds; near the nature reserve
""")
OPENERS = listed("""
    morning; good morning; good afternoon; evening; good evening; hello; hi; hi there; hey; hey there; ok team; ok; okay then; right; right then
    alright; all right then; ahoy; greetings; moin; howdy; g'day; listen up; attention; new job; new task; next job; next up; here's the plan
    here is the plan; here we go; job for you; task for you; got a job for you; a small job; one for you; plan for today; today's plan; for this trip
    for this run; on this trip; this afternoon; today; tonight; first job of the day; boat; dear boat; captain; skipper; vehicle; USV
    mission control here; control here; harbour control here; base here; bridge here; from the office; message from base; all stations; this is base
    this is control; operations here; ops here; sorry to bother you; when you have a minute; if you are free; change of plan; update; new orders
    orders as follows; request as follows; quick one; quick job; bit of a job; nothing fancy; as discussed; as agreed; as per the plan; for the record
    so; well; now; look; say
""")
CLOSERS = listed("""
    thanks; thank you; cheers; many thanks; much obliged; ta; over; out; over and out; that's all; that is all; that will be all; that's it
    that's the lot; end; end of message; please; if you please; would you; ok; okay; understood; got it; clear; copy; acknowledge; please acknowledge
    confirm receipt; let's go; go; off you go; good luck; have fun; safe trip; fair winds; take care; mind how you go; no hurry; no rush
    as soon as you can; ASAP; at your leisure; soonest; when ready; whenever suits; good hunting; see you later; see you; bye; regards; kind regards
    best; yours; all from me; nothing else; no more than that; nothing more; simple as that; easy; job done; you know the drill; do it well; carry on
    make it so; execute; proceed; standing by; break; end of orders; end of list
""")
