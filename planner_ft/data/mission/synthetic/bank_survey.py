"""How operators ask for surveys: boat landings, depths, cables and targets."""

from __future__ import annotations

from planner_ft.data.mission.synthetic.bank_adjuncts import RADIUS
from planner_ft.data.mission.synthetic.phrases import TaskPhrases, listed

BOAT_LANDING_CLEARANCE_SWEEP = TaskPhrases(
    imperatives=listed("""
        scan the boat landing of {target}; sweep the boat landing at {target} with the LiDAR; check the boat landing of {target} for clearance
        do a LiDAR scan of the boat landing at {target}; scan the landing at {target} with LiDAR; lidar the boat landing of {target}
        do a clearance sweep of the boat landing at {target}; sweep the landing area of {target}; check the landing at {target} for obstructions
        make a clearance scan of the landing at {target}; run a boat landing sweep at {target}; see that the boat landing of {target} is clear
        laser-scan the boat landing at {target}; map the clearance at the boat landing of {target}; measure the clearance of the boat landing of {target}
        make sure the boat landing at {target} is clear; sweep the boat landing of {target} for clearance; take a LiDAR sweep of the landing on {target}
        check with LiDAR that nothing fouls the boat landing of {target}; get the boat landing at {target} scanned
        run the LiDAR over the boat landing of {target}; do the boat landing clearance at {target}; verify clearance at the boat landing of {target}
        scan the landing area at {target} before anyone steps over; carry out a boat landing clearance sweep at {target}
        perform a landing clearance sweep on {target}; point-cloud the boat landing of {target}; check the crew landing of {target} with the LiDAR
        scan the transfer landing of {target} for clearance; look with LiDAR whether the boat landing at {target} is free
        sweep the bumper bars of the boat landing at {target} with LiDAR; get a LiDAR clearance picture of the landing at {target}
        prove the boat landing of {target} clear; survey the boat landing of {target} with LiDAR for clearance; give the landing at {target} a LiDAR sweep
    """),
    noun_phrases=listed("""
        a LiDAR scan of the boat landing at {target}; a clearance sweep of the boat landing of {target}; a boat landing scan at {target}
        a boat landing clearance sweep at {target}; a sweep of the landing area at {target}; a landing clearance check at {target}
        a clearance scan of the landing at {target}; a laser scan of the boat landing of {target}; a LiDAR sweep of the landing at {target}
        the clearance of the boat landing at {target}; a lidar pass over the boat landing of {target}; a scan of the crew landing at {target}
    """),
    gerunds=listed("""
        scanning the boat landing of {target}; sweeping the boat landing at {target}; doing a clearance sweep of the landing at {target}
        checking the boat landing of {target} for clearance; running the LiDAR over the landing at {target}; scanning the landing area at {target}
        laser-scanning the boat landing of {target}; doing the boat landing clearance at {target}; clearing the boat landing of {target} by LiDAR
    """),
    here_imperatives=listed("""
        scan the boat landing right here; sweep the boat landing with the LiDAR from where you are; check the landing here for clearance
        do the boat landing sweep from where you lie; check the landing you are at with the LiDAR
    """),
    bare_imperatives=listed("""
        scan the boat landing; sweep the boat landing with the LiDAR; check the boat landing for clearance; do a clearance sweep of the boat landing
        lidar the boat landing; do a LiDAR scan of the landing; check the landing; sweep the landing area; run a boat landing sweep
        make sure the boat landing is clear; get the landing scanned; scan its boat landing for clearance; do the boat landing clearance
    """),
    bare_noun_phrases=listed("""
        a boat landing scan; a clearance sweep of the boat landing; a LiDAR scan of the boat landing; a landing clearance check
        a boat landing clearance sweep; a LiDAR sweep of the landing area; a scan of its boat landing
    """),
    bare_gerunds=listed("""
        scanning the boat landing; sweeping the boat landing with the LiDAR; checking the boat landing for clearance; doing the boat landing clearance
        scanning its boat landing; running the boat landing sweep
    """),
)

_AREA_PAIR = listed("""
    {width} by {length}; over an area of {width} by {length}; in a box {width} by {length}; {width} x {length}; over {width} by {length}
    {width} wide and {length} long; {length} long and {width} wide; an area {width} by {length}; {width} wide by {length} long
    with a width of {width} and a length of {length}; in a {width} by {length} grid; width {width}, length {length}; length {length}, width {width}
    on a patch {width} by {length}; a box of {width} by {length}; on a field of {width} x {length}; covering {width} by {length}
""")

BATHYMETRY_GRID_SURVEY = TaskPhrases(
    imperatives=listed("""
        survey the depths around {target}; do a depth survey at {target}; map the seabed around {target}; sound the bottom at {target}
        do a bathymetry survey at {target}; run a bathymetry grid at {target}; map the depths round {target}; do a depth grid centred on {target}
        run survey lines over the bottom at {target}; lawnmow the seabed at {target}; take soundings over the area at {target}
        chart the bottom around {target}; measure the water depth over the area round {target}; do a lawnmower depth survey around {target}
        run a bathymetric survey centred on {target}; run a depth survey about {target}; get depths over an area centered on {target}
        sound out the area around {target}; make a depth map of the area round {target}; grid the seabed round {target}
        scan the seabed around {target} in a lawnmower pattern; run sounding lines around {target}; plumb the depths around {target}
        do the bathymetry round {target}; run an echo sounder grid over {target}; mow the bottom at {target} for depths
        collect bathymetry around {target}; survey the seabed about {target}; make a sounding survey of the patch at {target}
        profile the sea floor around {target}; lay a depth grid over {target}; fill in the depths around {target} line by line
        carry out a seabed depth survey at {target}; do a grid of soundings centred at {target}; perform a bathymetry grid survey at {target}
        get me the depths around {target}; find how deep it is all over the area round {target}; take a grid of depths about {target}
        go up and down with the echo sounder around {target}; do a hydrographic grid about {target}
    """),
    noun_phrases=listed("""
        a depth survey around {target}; a bathymetry survey centred on {target}; a bathymetry grid at {target}; a depth grid around {target}
        a seabed survey at {target}; depths over the area around {target}; a sounding grid at {target}; a depth map of the area round {target}
        a lawnmower survey of the bottom around {target}; a set of sounding lines around {target}; bathymetry around {target}
        a bathymetric survey of the patch at {target}; a chart of the bottom round {target}; soundings over the area about {target}
        a seabed depth grid centered on {target}
    """),
    gerunds=listed("""
        surveying the depths around {target}; mapping the seabed around {target}; doing a depth survey at {target}; running the bathymetry at {target}
        sounding the bottom around {target}; running a depth grid over {target}; charting the bottom round {target}; taking soundings around {target}
        doing the bathymetry grid about {target}; mowing the seabed at {target}; gridding the depths around {target}
    """),
    adjuncts={
        "width+length": _AREA_PAIR,
        "width": listed("""
            {width} wide; with a width of {width}; over a width of {width}; width {width}; in a strip {width} wide; over a {width_compound} wide strip
            {width} across; {width} from west to east; with the box {width} wide
        """),
        "length": listed("""
            {length} long; with a length of {length}; over a length of {length}; length {length}; in a strip {length} long
            with lines {length} long; {length} from south to north; with the box {length} long
        """),
        "spacing": listed("""
            with lines {spacing} apart; with {spacing_compound} lines; lines every {spacing}; at {spacing} spacing; with {spacing} between lines
            line spacing {spacing}; with a line spacing of {spacing}; in lanes {spacing} apart; a line every {spacing}; with tracks {spacing} apart
            on {spacing_compound} spacing; {spacing} from lane to lane; with {spacing} between lanes; spaced {spacing}
        """),
    },
    bare_imperatives=listed("""
        do a depth survey; map the seabed; run a bathymetry grid; survey the depths; sound out the bottom; do a bathymetry survey; chart the bottom there
        run a depth grid; do a lawnmower depth survey; map the depths; get the depths there; take soundings over the area
    """),
    bare_noun_phrases=listed("""
        a depth survey; a bathymetry grid; a bathymetry survey; a depth grid; a seabed depth survey; a sounding grid; a depth map of the area
    """),
    bare_gerunds=listed("""
        doing a depth survey; mapping the seabed; running a bathymetry grid; surveying the depths; sounding out the bottom; mapping the depths
    """),
    valued_imperatives=listed("""
        map the depths of a {width} by {length} box centred on {target}; do a {width} by {length} depth survey around {target}
        run a {width} by {length} bathymetry grid at {target}; sound a patch {width} by {length} around {target}
        get depths over a patch {length} long and {width} wide centred on {target}; grid {width} by {length} of seabed round {target}
        sound out {width} by {length} of bottom at {target}; do a {width} x {length} depth grid over {target}
    """),
    valued_noun_phrases=listed("""
        a {width} by {length} depth survey around {target}; a {width} by {length} depth grid centred on {target}
        depths over {width} by {length} around {target}
        bathymetry of a {width} by {length} box at {target}; a depth map {width} wide and {length} long around {target}
        a {width} x {length} bathymetry grid at {target}
    """),
)

SUBSEA_CABLE_TRACK = TaskPhrases(
    imperatives=listed("""
        track {cable}; follow {cable} by sonar; trace {cable} on the sonar; follow the run of {cable}; track {cable} with the sonar
        follow {cable} along the seabed; run the length of {cable} on sonar; trace the route of {cable}; trace {cable} along the bottom
        keep over {cable} and follow it; sonar-track {cable}; follow where {cable} goes; pick up {cable} and track it; run along {cable} by sonar
        stay on top of {cable} and track it; do a cable track of {cable}; survey the route of {cable} with sonar; sail along {cable} on sonar
        work along {cable} with the sonar; follow the track of {cable}; trail {cable} on the sonar; ride {cable} on the sonar
        do a sonar track on {cable}; get on {cable} and follow it; go along the line of {cable} with the sonar; walk {cable} on the sonar
        run a cable track over {cable}; run down {cable} with the sonar on; keep {cable} in the sonar and follow; chase {cable} along the seafloor
        carry out a cable track of {cable}; scan along {cable} by sonar; conduct a subsea cable track on {cable}
        trace out the lie of {cable}; go over {cable} with the sonar from end to end; start a track on {cable}; follow {cable} under the water
    """),
    noun_phrases=listed("""
        a sonar track of {cable}; a track along {cable}; a cable track on {cable}; a sonar run along {cable}; a trace of {cable}
        a track of {cable}; a sonar trace of {cable}; a run over {cable} with the sonar; a route survey of {cable} by sonar
        a follow of {cable} on sonar; a subsea track of {cable}; a seabed track down {cable}
    """),
    gerunds=listed("""
        tracking {cable}; following {cable} by sonar; tracing {cable} on sonar; tracking {cable} with the sonar; running along {cable} on sonar
        following {cable} along the bottom; tracing the route of {cable}; doing the cable track on {cable}; following the run of {cable}
        working along {cable} by sonar
    """),
    adjuncts={
        "start": listed("""
            from {start}; starting at {start}; beginning at {start}; from {start} on; starting from {start}; start point {start}; with the start at {start}
            picking it up at {start}; commencing at {start}; from the start at {start}; from a start at {start}
        """),
        "heading": listed("""
            on a heading of {heading}; heading {heading}; bearing {heading}; on a bearing of {heading}; on course {heading}; steering {heading}
            on {heading}; along {heading}; course {heading}; running {heading}; with heading {heading}; laid on {heading}
        """),
        "heading:word": listed("""
            heading {heading}; towards the {heading}; to the {heading}; on a {heading} heading; going {heading}; running {heading}; bearing {heading}
            in a {heading} direction; out to the {heading}; toward {heading}; steering {heading}; where it runs {heading}
        """),
        "max_dist": listed("""
            for {max_dist}; for at most {max_dist}; no further than {max_dist}; up to {max_dist}; {max_dist} at most; {max_dist} maximum; max {max_dist}
            for no more than {max_dist}; not beyond {max_dist}; for {max_dist} and no further; over {max_dist}; stopping after {max_dist}
            as far as {max_dist}; for the first {max_dist}
        """),
    },
    valued_imperatives=listed("""
        track {max_dist} of {cable}; follow {max_dist} of {cable} by sonar; from {start} track {cable}; starting at {start}, follow {cable} by sonar
        pick {cable} up at {start} and track it; run {max_dist} along {cable} on sonar
    """),
    valued_noun_phrases=listed(
        "a {max_dist_compound} track of {cable}; a sonar track over {max_dist} of {cable};"
        " {max_dist} of cable track along {cable}"
    ),
)

SURVEY_TARGET = TaskPhrases(
    imperatives=listed("""
        inspect {target}; survey {target}; look over {target}; gather data about {target}; document {target}; examine {target}
        take a close look at {target}; do an inspection of {target}; carry out a survey of {target}; have a good look at {target}
        check {target} over; check out {target}; give {target} a thorough look; assess {target}; collect data on {target}; inspect all of {target}
        run an inspection on {target}; do a survey of {target}; perform a survey of {target}; record the state of {target}
        look {target} over for damage; see what shape {target} is in; document the condition of {target}; go over {target} closely
        give {target} the once-over; scope out {target}; do a condition survey of {target}; study {target}; vet {target}
        collect inspection data at {target}; get inspection data on {target}; conduct an inspection of {target}; make a survey of {target}
        inspect {target} for damage; look into the condition of {target}; gather everything you can on {target}; have a proper look at {target}
        do a general inspection of {target}; scrutinise {target}; do a visual inspection of {target}; work up a survey of {target}
        eyeball {target}; gather sensor data about {target}; do a photo survey of {target}; collect LiDAR data on {target}; do a video inspection of {target}
        inspect the north face of {target}; survey the east side of {target}; look over the seaward wall of {target}; examine the port side of {target}
        check the west face of {target} over for damage; gather data about the south wall of {target}; document the starboard side of {target}
    """),
    noun_phrases=listed("""
        an inspection of {target}; a survey of {target}; a close look at {target}; a condition survey of {target}; a look over {target}
        inspection data on {target}; a check of the state of {target}; data about {target}; a visual inspection of {target}
        a general survey of {target}; an examination of {target}; a proper look at {target}; a damage inspection of {target}
        a documentation of {target}; a once-over of {target}
    """),
    gerunds=listed("""
        inspecting {target}; surveying {target}; looking over {target}; examining {target}; documenting {target}; checking {target} over
        gathering data about {target}; doing an inspection of {target}; carrying out a survey of {target}; having a look at {target}
        assessing {target}; going over {target}
    """),
    adjuncts={"radius": RADIUS},
    valued_imperatives=listed("""
        survey {target} from {radius} out; inspect {target} {radius} off; inspect {target} with {radius} between you and it
        look {target} over from {radius} away; give {target} {radius} and inspect it
    """),
    valued_noun_phrases=listed("""
        a survey of {target} from {radius} off; an inspection of {target} at {radius}; an inspection of {target} with {radius} of stand-off
    """),
)

BANK_SURVEY = {
    "BoatLandingClearanceSweep": BOAT_LANDING_CLEARANCE_SWEEP,
    "BathymetryGridSurvey": BATHYMETRY_GRID_SURVEY,
    "SubseaCableTrack": SUBSEA_CABLE_TRACK,
    "SurveyTarget": SURVEY_TARGET,
}
