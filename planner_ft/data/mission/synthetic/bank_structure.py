"""How operators ask for movements about a structure and for docking."""

from __future__ import annotations

from planner_ft.data.mission.synthetic.bank_adjuncts import DISTANCE, RADIUS, SPEED
from planner_ft.data.mission.synthetic.phrases import TaskPhrases, listed

PERFORM_ORBIT = TaskPhrases(
    imperatives=listed("""
        circle {target}; orbit {target}; go round {target}; go around {target}; do a loop of {target}; do a lap of {target}
        drive round {target}; sail around {target}; make a circuit of {target}; fly an orbit round {target}; do an orbit of {target}
        run a ring round {target}; make a round of {target}; put an orbit on {target}; circumnavigate {target}; loop round {target}
        do a circle around {target}; steam round {target}; swing round {target}; do a ring around {target}; go about {target} in a circle
        perform an orbit around {target}; execute an orbit of {target}; steer a circle round {target}; encircle {target}
        run circular about {target}; take a spin round {target}; cruise around {target}; make an orbit round {target}
        lay an orbit around {target}; work your way round {target}; walk her round {target}; take a turn around {target}
        ring {target}; motor round {target}; do a circular pass about {target}; start an orbit about {target}
        curve round {target}; trace a circle about {target}; go circling {target}; run an orbit pattern on {target}; travel round {target}
    """),
    noun_phrases=listed("""
        an orbit of {target}; a slow lap round {target}; a circuit of {target}; a loop round {target}; a circle round {target}
        an orbit around {target}; a turn around {target}; a ring round {target}; a round of {target}; a circular run about {target}
        a lap of {target}; a circling of {target}; a circular pass round {target}; a spin round {target}; an orbital pass of {target}
        a tour round {target}
    """),
    gerunds=listed("""
        circling {target}; orbiting {target}; going round {target}; doing an orbit of {target}; going around {target}
        looping round {target}; making a circuit of {target}; doing a lap of {target}; sailing round {target}; driving round {target}
        running a ring about {target}; circumnavigating {target}; swinging around {target}
    """),
    adjuncts={
        "radius": RADIUS,
        "speed": SPEED,
        "arc:360": listed("""
            once; just once; once round; in a full circle; for a full circle; in one complete circle; a full turn; one complete lap
            making a full circuit; once and no more; for one full revolution; the full 360; once all the way round; one full lap
            in a full round; a complete 360
        """),
        "arc:180": listed("""
            half way round; in a half circle; for half a turn; half a circle only; just the half circle; for half a lap; half a lap
            stopping half way round; only half the way round; a half turn; for half a circuit
        """),
        "arc:90": listed("""
            a quarter of the way round; for a quarter turn; in a quarter circle; only a quarter of a circle; just the quarter circle
            for a quarter of a lap; a quarter turn; stopping after a quarter circle; a quarter lap
        """),
        "arc": listed("""
            over an arc of {arc}; for {arc}; through {arc}; in a {arc_compound} arc; for {arc} of arc; an arc of {arc}; covering {arc}
            only {arc} of it; through an angle of {arc}; stopping after {arc}; {arc} worth; arc {arc}
        """),
        "arc_noun:360": listed("""
            a full circle; a complete circle; one full lap; a full orbit; a complete circuit; a full loop; one complete orbit; a full 360
            a complete lap; a full round; one complete turn
        """),
        "arc_noun:180": listed(
            "half a circle; a half circle; half an orbit; a half orbit; half a lap; a half loop;"
            " half a turn; a half turn"
        ),
        "arc_noun:90": listed(
            "a quarter circle; a quarter orbit; a quarter of a circle; a quarter turn; a quarter"
            " lap; a quarter of an orbit"
        ),
        "arc_noun": listed(
            "a {arc_compound} arc; an arc of {arc}; a {arc_compound} orbit; {arc} of a circle; a"
            " partial orbit of {arc}"
        ),
    },
    valued_imperatives=listed("""
        do {arc_noun} round {target}; make {arc_noun} around {target}; give me {arc_noun} round {target}; run {arc_noun} about {target}
        go {arc_noun} round {target}; fly {arc_noun} around {target}; draw {arc_noun} about {target} {radius} off
        put a {radius_compound} ring round {target}; run a {radius_compound} orbit on {target}; do a {radius_compound} circle about {target}
        finish {arc_noun} about {target}; go round {target} keeping {radius} between you and it; give {target} {radius} and circle it
    """),
    valued_noun_phrases=listed("""
        {arc_noun} round {target}; {arc_noun} around {target}; {arc_noun} about {target}; {arc_noun} of the boat round {target}
        a {radius_compound} orbit of {target}; a {radius_compound} circle round {target}; a circle of {radius} radius about {target}
    """),
)

PARALLEL_STRUCTURE_PASS = TaskPhrases(
    imperatives=listed("""
        run along the {side_id} side of {target}; run along the {side_id} face of {target}; run along the {side_id} wall of {target}
        pass along the {side_id} side of {target}; pass parallel to the {side_id} face of {target}; go along the {side_id} wall of {target}
        make a pass down the {side_id} side of {target}; do a straight pass along the {side_id} face of {target}
        drive along the {side_id} side of {target}; sail along the {side_id} face of {target}; ride along the {side_id} side of {target}
        follow the {side_id} wall of {target}; follow the {side_id} side of {target} end to end; track along the {side_id} face of {target}
        do a parallel pass on the {side_id} side of {target}; run parallel to the {side_id} wall of {target}
        steam down the {side_id} side of {target}; cruise along the {side_id} face of {target}; go down the {side_id} side of {target}
        work along the {side_id} wall of {target}; fly a line past the {side_id} face of {target}; scan along the {side_id} side of {target}
        move parallel to the {side_id} side of {target}; travel down the {side_id} face of {target}; slide along the {side_id} side of {target}
        do a run past the {side_id} side of {target}; make a run down the {side_id} wall of {target}; take a line along the {side_id} face of {target}
        creep along the {side_id} side of {target}; keep parallel to the {side_id} side of {target} and run past it
        run a straight line along the {side_id} face of {target}; motor along the {side_id} wall of {target}
        walk down the {side_id} side of {target}; hug the {side_id} face of {target} on a straight pass; make a sweep along the {side_id} side of {target}
        execute a structure pass on the {side_id} face of {target}; coast along the {side_id} wall of {target}
        pass alongside the {side_id} flank of {target}; patrol the {side_id} wall of {target} in a straight line
        run along {target}; make a pass along {target}; run parallel to {target}; do a straight pass along {target}; do a parallel pass of {target}
        sail down the length of {target}; drive a line parallel to {target}; go along the face of {target}; run along the wall of {target}
    """),
    noun_phrases=listed("""
        a run along the {side_id} side of {target}; a pass along the {side_id} face of {target}; a pass down the {side_id} wall of {target}
        a straight run past the {side_id} face of {target}; a parallel pass on the {side_id} side of {target}
        a run down the {side_id} side of {target}; a line along the {side_id} wall of {target}; a straight pass of the {side_id} side of {target}
        a {side_id} side pass of {target}; a {side_id} face pass on {target}; a {side_id} wall run at {target}; a drive-by of the {side_id} face of {target}
        a parallel run along {target}; a pass along {target}; a straight run down {target}; a structure pass of {target}
    """),
    gerunds=listed("""
        running along the {side_id} side of {target}; passing along the {side_id} face of {target}; going along the {side_id} wall of {target}
        doing a pass down the {side_id} side of {target}; driving along the {side_id} face of {target}; passing parallel to the {side_id} side of {target}
        sailing down the {side_id} side of {target}; following the {side_id} wall of {target}; running past the {side_id} face of {target}
        running parallel to {target}; making a pass along {target}; passing along {target}
    """),
    adjuncts={
        "side_id": listed("""
            along its {side_id} side; on the {side_id} side; down the {side_id} face; past the {side_id} wall; on its {side_id} face
            {side_id} side; {side_id} face; taking the {side_id} side; the {side_id} side of it
        """),
        "length": listed("""
            for {length}; over {length}; {length} of it; for a length of {length}; {length} long; for {length} of its length; covering {length}
            over a length of {length}; a stretch of {length}; length {length}; {length} in all; for the first {length}; a {length_compound} run
        """),
        "distance": DISTANCE,
        "speed": SPEED,
    },
    bare_imperatives=listed("""
        run along its {side_id} side; make a pass down its {side_id} face; pass along its {side_id} wall; go down the {side_id} side
        do a straight pass along the {side_id} face; run the {side_id} wall; do the {side_id} side in a parallel pass; ride down its {side_id} side
        sail along the {side_id} face
    """),
    bare_noun_phrases=listed("""
        a {side_id} side pass; a {side_id} face run; a run along the {side_id} side; a pass down the {side_id} face; a run down its {side_id} wall
    """),
    bare_gerunds=listed("""
        running along its {side_id} side; making a pass down its {side_id} face; passing along its {side_id} wall; going down the {side_id} side
        running the {side_id} wall; doing a straight pass along the {side_id} face
    """),
    valued_imperatives=listed("""
        do a {length_compound} run along the {side_id} side of {target}; run {length} along the {side_id} face of {target}
        make a {length_compound} pass down the {side_id} wall of {target}; cover {length} of the {side_id} side of {target} in a pass
        go {length} along the {side_id} wall of {target}; drive past {length} of the {side_id} face of {target}
        do a {length_compound} pass along {target}; run {length} down {target}
    """),
    valued_noun_phrases=listed("""
        a {length_compound} run along the {side_id} side of {target}; a {length_compound} pass down the {side_id} face of {target}
        {length} of the {side_id} wall of {target} as a pass; a {length_compound} pass along {target}
    """),
)

DOCKING_APPROACH = TaskPhrases(
    imperatives=listed("""
        dock at {target}; berth at {target}; moor up at {target}; go alongside at {target}; come alongside at {target}; tie up at {target}
        put her alongside at {target}; bring her into {target} and dock; dock yourself at {target}; park her at {target}, alongside
        make the docking approach to {target}; do a docking approach at {target}; make fast at {target}; lie alongside at {target}
        bring the boat alongside at {target}; take your berth at {target}; slot into the berth at {target}; come in and dock at {target}
        head in and berth at {target}; put in at {target}; pull in at {target} and moor; go in to dock at {target}; finish docked at {target}
        end up alongside at {target}; bring yourself in to dock at {target}; get alongside at {target}; dock on GPS at {target}
        tuck into the dock at {target}; lay her alongside at {target}; settle into the berth at {target}; come in to moor at {target}
        approach {target} and dock; run in to {target} and berth; line up on {target} and dock; get docked at {target}; get moored at {target}
        get yourself berthed at {target}; come home and dock at {target}; return and berth at {target}
        head back and moor at {target}; come back in to dock at {target}; return to dock at {target}; head home to the berth at {target}
    """),
    noun_phrases=listed("""
        a docking at {target}; a berth at {target}; a docking approach to {target}; a GPS docking at {target}; a mooring at {target}
        a landing alongside at {target}; an approach to the berth at {target}; a berthing at {target}; a dock approach on GPS at {target}
        a docking run into {target}; a clean docking at {target}; an alongside mooring at {target}
    """),
    gerunds=listed("""
        docking at {target}; berthing at {target}; mooring up at {target}; going alongside at {target}; tying up at {target}
        coming alongside at {target}; making fast at {target}; getting docked at {target}; putting her alongside at {target}
        bringing her in to dock at {target}; taking the berth at {target}
    """),
)

VISUAL_DOCKING_APPROACH = TaskPhrases(
    imperatives=listed("""
        dock by camera on {target_feature}; dock visually on {target_feature}; use the camera to dock on {target_feature}
        do a visual docking on {target_feature}; make a camera-guided approach to {target_feature}; dock on {target_feature} with the camera
        steer in on {target_feature} by camera; let the camera bring you in on {target_feature}; home in visually on {target_feature} and dock
        dock using {target_feature} as the visual mark; guide yourself in on {target_feature} with the camera; berth by camera on {target_feature}
        perform a visual docking approach on {target_feature}; come in on {target_feature} by camera; dock camera-guided on {target_feature}
        keep {target_feature} in the camera and dock on it; make your final approach on {target_feature} with vision
        lock the camera on {target_feature} and come in to dock; approach {target_feature} visually for docking; run in on {target_feature} by vision
        dock off {target_feature} using the camera; bring her in to dock by camera, mark is {target_feature}
        take {target_feature} as your mark and dock visually
        ease in to {target_feature} on camera guidance; go in visually on {target_feature}; dock by sight of {target_feature}
        aim the camera at {target_feature} and dock on it; use {target_feature} for a visual docking; let {target_feature} guide the camera docking
        do the docking with the camera locked on {target_feature}; finish with a camera docking on {target_feature}
        dock with visual guidance from {target_feature}; put the camera on {target_feature} and let it take you in; go alongside by camera on {target_feature}
        moor by camera on {target_feature}; do a vision-guided final on {target_feature}; track {target_feature} with the camera and dock
        centre {target_feature} in the camera and dock on it; ride the camera in on {target_feature}; berth visually against {target_feature}
    """),
    noun_phrases=listed("""
        a camera docking on {target_feature}; a visual docking on {target_feature}; a visual approach to {target_feature}
        a camera-guided docking on {target_feature}; a vision docking on {target_feature}; a final approach by camera on {target_feature}
        a camera approach on {target_feature}; a docking by camera on {target_feature}; a camera-guided final on {target_feature}
        a visual berthing on {target_feature}; a vision-guided approach to {target_feature}; a docking run by camera on {target_feature}
    """),
    gerunds=listed("""
        docking by camera on {target_feature}; docking visually on {target_feature}; coming in by camera on {target_feature}
        making a camera-guided approach to {target_feature}; berthing by camera on {target_feature}; docking on {target_feature} with the camera
        steering in visually on {target_feature}; homing in on {target_feature} by camera; going in on {target_feature} by vision
        using the camera to dock on {target_feature}
    """),
    adjuncts={
        "distance": listed("""
            stopping {distance} off; stop {distance} short of it; {distance} off; halting at {distance}; up to {distance} from it
            leaving {distance}; to a distance of {distance}; and stop at {distance}; ending {distance} away; {distance} short; until you are {distance} off
            closing to {distance}; holding at {distance} from it; down to {distance}
        """)
    },
    bare_imperatives=listed("""
        dock by camera; do a visual docking; use the camera to dock; dock visually; make a camera-guided docking; come in to dock by camera
        perform a visual docking approach; berth by camera; let the camera guide the docking; do a camera docking
    """),
    bare_noun_phrases=listed(
        "a camera docking; a visual docking; a camera-guided approach to the dock; a visual docking"
        " approach"
    ),
    bare_gerunds=listed("""
        docking by camera; docking visually; doing a visual docking; coming in to dock by camera; using the camera to dock; berthing by camera
    """),
)

BANK_STRUCTURE = {
    "PerformOrbit": PERFORM_ORBIT,
    "ParallelStructurePass": PARALLEL_STRUCTURE_PASS,
    "DockingApproach": DOCKING_APPROACH,
    "VisualDockingApproach": VISUAL_DOCKING_APPROACH,
}
