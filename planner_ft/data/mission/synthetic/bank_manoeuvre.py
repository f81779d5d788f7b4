"""How operators ask to go, to hold, to drift and to follow."""

from __future__ import annotations

from planner_ft.data.mission.synthetic.bank_adjuncts import DURATION
from planner_ft.data.mission.synthetic.phrases import TaskPhrases, listed

BANK_RETURN = listed("""
    return home; come back; RTB; head back to base; come home; go home; return to base; head home; get yourself home; come on back
    return to the start; go back to where you started; make your way home; bring her home; bring her back in; head back in
    run for home; set course for home; sail home; proceed home; transit back to base; drive back to home; get back here
    come back to us; return to home; make for home; turn round and come home; get back to base; steam home; go back to base
    return to the launch point; come back to the launch point; head for home; be on your way home; point her home
    get the boat back home; call it a day and come home; knock off and head home; return to home position; return to origin
""")

TRANSIT = TaskPhrases(
    imperatives=listed("""
        go to {target}; head for {target}; proceed to {target}; make your way to {target}; transit to {target}; move to {target}
        sail to {target}; steam to {target}; get over to {target}; run out to {target}; navigate to {target}; drive over to {target}
        set course for {target}; relocate to {target}; reposition to {target}; make for {target}; steer for {target}; shift to {target}
        take yourself to {target}; pop over to {target}; nip across to {target}; motor over to {target}; head over to {target}
        go over to {target}; travel to {target}; swing by {target}; get yourself to {target}; cruise to {target}; come up to {target}
        bring her up to {target}; take the boat to {target}; scoot over to {target}; press on to {target}; continue to {target}
        carry on to {target}; advance to {target}; cross over to {target}; mosey over to {target}; put yourself at {target}
        close on {target}; approach {target}; drop by {target}; waypoint to {target}; beat it over to {target}; hop across to {target}
    """),
    noun_phrases=listed("""
        a transit to {target}; a run out to {target}; a trip to {target}; a repositioning to {target}; a move to {target}
        a passage to {target}; a hop over to {target}; a short run across to {target}; a relocation to {target}
        the transit leg to {target}; the way out to {target}; a leg to {target}; a direct transit out to {target}
        a straight run to {target}
    """),
    gerunds=listed("""
        going to {target}; heading for {target}; proceeding to {target}; making your way to {target}; moving to {target}
        transiting to {target}; sailing to {target}; running out to {target}; getting to {target}; steaming over to {target}
        repositioning to {target}; making for {target}; navigating to {target}
    """),
)

FOLLOW_TARGET = TaskPhrases(
    imperatives=listed("""
        follow {target}; track {target}; shadow {target}; tail {target}; stay with {target}; stick with {target}; keep up with {target}
        keep after {target}; trail {target}; pursue {target}; chase {target}; stay on the tail of {target}; keep on the heels of {target}
        go after {target} and stay on it; keep company with {target}; escort {target}; accompany {target}; dog {target}; stalk {target}
        follow behind {target}; fall in behind {target}; tuck in behind {target}; keep station on {target} as it moves
        move along with {target}; go wherever {target} goes; sail along with {target}; hang on to {target}; keep close to {target} as it goes
        keep tabs on {target} and follow it; start tracking {target}; lock on to {target} and follow; stay glued to {target}
        keep a tail on {target}; stay astern of {target}; match the movements of {target}; pick up {target} and shadow it
        run with {target}; keep pace with {target}; keep hold of {target} wherever it goes; ride along behind {target}; sit on the tail of {target}
    """),
    noun_phrases=listed("""
        a tail on {target}; a shadow on {target}; a close escort for {target}; continuous tracking of {target}; a follow on {target}
        tracking of {target}; an escort of {target}; a follow-up behind {target}; a running track on {target}; pursuit of {target}
        someone on the tail of {target}; a shadowing run on {target}
    """),
    gerunds=listed("""
        following {target}; tracking {target}; shadowing {target}; tailing {target}; staying with {target}; trailing {target}
        keeping up with {target}; escorting {target}; chasing {target}; sticking with {target}; keeping company with {target}
        accompanying {target}
    """),
    adjuncts={
        "target_position": listed("""
            last seen at {target_position}; last reported at {target_position}; last known at {target_position}; now at {target_position}
            currently at {target_position}; last plotted at {target_position}; last fix {target_position}; presently at {target_position}
            at {target_position} a minute ago; showing at {target_position}; somewhere round {target_position}; picked up at {target_position}
            position {target_position}
        """)
    },
    valued_imperatives=listed("""
        get on {target_id} at {target_position} and follow; pick {target_id} up at {target_position} and tail it
        intercept {target_id} at {target_position} and shadow it
    """),
)

KEEP_STATION = TaskPhrases(
    imperatives=listed("""
        hold position at {target}; keep station at {target}; stay at {target}; hold at {target}; wait at {target}; loiter at {target}
        remain at {target}; stand by at {target}; stay put at {target}; sit tight at {target}; park yourself at {target}
        hold station off {target}; stay beside {target}; lie off {target}; hang around at {target}; hold steady at {target}
        wait next to {target}; stay close by {target}; keep position at {target}; remain on station at {target}; maintain position at {target}
        station yourself at {target}; take up station at {target}; stay alongside {target}; hover at {target}; hold next to {target}
        plant yourself at {target}; lie to at {target}; heave to at {target}; hold fast at {target}; stay in place at {target}; idle at {target}
        stick around at {target}; rest at {target}; keep her at {target}; stand off {target} and wait; hang about near {target}
        linger at {target}; pause at {target}; stay on the spot at {target}
    """),
    noun_phrases=listed("""
        a hold at {target}; station keeping at {target}; a station hold at {target}; a wait at {target}
        a stand-by at {target}; a position hold at {target}; a stay at {target}; a loiter at {target}; a pause at {target}
        dynamic positioning at {target}; a stationary spell at {target}; position keeping at {target}
    """),
    gerunds=listed("""
        holding position at {target}; keeping station at {target}; waiting at {target}; holding at {target}; staying at {target}
        standing by at {target}; loitering at {target}; remaining at {target}; lying off {target}; staying beside {target}
        sitting tight at {target}; hanging around at {target}
    """),
    adjuncts={"duration": DURATION},
    here_imperatives=listed("""
        stay where you are; hold position here; hold it right there; wait where you are; keep station on the spot; stay put
        remain where you are; hold your present position; stop here and hold; stand by where you are; sit tight
        stay exactly where you are; hold your ground; loiter where you are; freeze there; park it right here; keep your position
        stay on this spot; hold this position; maintain present position; wait right there
    """),
    bare_imperatives=listed("""
        hold position; keep station; hold station; wait; stay there; hold there; loiter; stand by there; stay in position; hang on there
        hold; remain on station; lie to; wait there; keep her steady in position; stay on the spot; heave to; hover; sit there
    """),
    bare_noun_phrases=listed(
        "a station hold; a position hold; station keeping; a wait there; a hold; a stand-by; a"
        " stationary spell"
    ),
    bare_gerunds=listed("""
        holding position; keeping station; waiting; holding; standing by; lying to; loitering; sitting tight
    """),
    valued_imperatives=listed("""
        stay with {target} for {duration}; give it {duration} on station at {target}; spend {duration} at {target}
        wait {duration} at {target}; hold {duration} at {target}; stick with {target} for {duration}; do {duration} of station keeping at {target}
        wait {duration}; hold {duration}; give it {duration} on the spot; stay there {duration}; keep {target} company for {duration}
    """),
    valued_noun_phrases=listed("""
        {duration} on station at {target}; {duration} of station keeping at {target}; a {duration_compound} hold at {target}
        a {duration_compound} wait at {target}; a {duration_compound} stop at {target}; {duration} of waiting at {target}
        a {duration_compound} hold; {duration} on station; a {duration_compound} wait; {duration} of holding position
    """),
)

DRIFT_AUDIT = TaskPhrases(
    imperatives=listed("""
        drift at {target}; cut the engines at {target} and drift; kill the engines at {target} and log the drift; float free at {target}
        shut off propulsion at {target} and drift; let yourself drift at {target}; go adrift at {target}; log the drift at {target}
        measure the drift at {target}; do a drift test at {target}; run a drift audit at {target}; record your passive drift at {target}
        switch the thrusters off at {target} and let her go; drift with the current at {target}; stop the motors at {target} and float
        see how you drift at {target}; let the current carry you from {target}; drift engines-off at {target}; float with engines off at {target}
        carry out a free drift at {target}; perform a drift log at {target}; lie a-hull at {target} and log it; drift freely from {target}
        power down the thrusters at {target} and drift; turn the propulsion off at {target} and log where you go; drift passively at {target}
        make a drift measurement at {target}; do a drift run from {target}; let the boat float loose at {target}; coast engines-off at {target}
        cut power at {target} and let it drift; let the tide take you from {target}; go dead in the water at {target} and log the set
        log your set and drift at {target}; stop engines at {target} and let the stream carry you; drift beside {target}
        ride the current with the motors off at {target}; quit propulsion at {target} and log the float; drift off {target}
    """),
    noun_phrases=listed("""
        a drift at {target}; a drift test at {target}; a drift audit at {target}; a drift log at {target}; a free drift at {target}
        a passive drift at {target}; an engines-off drift at {target}; a drift measurement at {target}; a drift run from {target}
        a drift record at {target}; a set and drift log at {target}; a propulsion-off float at {target}; a drift check at {target}
        a spell adrift at {target}
    """),
    gerunds=listed("""
        drifting at {target}; drifting engines-off at {target}; logging the drift at {target}; floating free at {target}
        cutting the engines at {target} and drifting; running a drift audit at {target}; measuring the drift at {target}
        doing a drift test at {target}; letting yourself drift at {target}; going adrift at {target}; drifting beside {target}
    """),
    adjuncts={"duration": DURATION},
    here_imperatives=listed("""
        cut the engines and drift where you are; drift from where you are; kill the motors right here and log the drift
        drift on the spot; float free from here; shut down propulsion here and drift; let her drift from where she is
        go adrift right here; log the drift from your present position; do a drift test where you are
    """),
    bare_imperatives=listed("""
        drift; log the drift; cut the engines and drift; kill the engines and let yourself drift; do a drift test; run a drift audit
        float engines-off; shut off the thrusters and drift; let the current take you; go adrift; measure your drift; drift with the current
        switch propulsion off and log the drift; record the drift; stop the motors and float; cut propulsion and drift; float free
    """),
    bare_noun_phrases=listed("""
        a drift log; a drift test; a drift audit; a free drift; an engines-off drift; a drift measurement; a passive drift
    """),
    bare_gerunds=listed("""
        drifting; logging the drift; drifting engines-off; floating free; doing a drift test; letting the current take you; running a drift audit; going adrift
    """),
    valued_imperatives=listed("""
        drift {duration} at {target}; do {duration} of drifting at {target}; spend {duration} adrift at {target}
        log {duration} of drift at {target}; float {duration} with the engines off; drift {duration}; log {duration} of free drift
        give it {duration} adrift
    """),
    valued_noun_phrases=listed("""
        {duration} of drift at {target}; a {duration_compound} drift at {target}; {duration} adrift at {target}; a {duration_compound} drift
        {duration} of free drift; a {duration_compound} drift log; a {duration_compound} drift test at {target}
    """),
)

BANK_MANOEUVRE = {
    "Transit": TRANSIT,
    "FollowTarget": FOLLOW_TARGET,
    "KeepStation": KEEP_STATION,
    "DriftAudit": DRIFT_AUDIT,
}
