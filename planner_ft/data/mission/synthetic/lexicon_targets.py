"""What a boat is sent to: nouns by group with the words that suit them, things that move, and call
signs. All without articles.
"""

from __future__ import annotations

from planner_ft.data.mission.synthetic.phrases import listed

NOUNS: dict[str, tuple[str, ...]] = {
    "mark": listed("""
        buoy; can buoy; nun buoy; wreck buoy; mooring buoy; cardinal buoy; fairway buoy; weather buoy; wave buoy; marker buoy; spar buoy; data buoy
        channel buoy; bell buoy; light buoy; lateral buoy; anchor buoy; pick-up buoy; marker; special mark; racing mark; range marker; channel marker
        beacon; leading light; sector light; day mark; perch; withy; navigation light; tide gauge; tide staff; current meter; wave rider; float
        hydrophone; sensor node; solar float; drifter; racon; light float; isolated danger mark; starboard-hand buoy; port-hand buoy; guard buoy
        measuring buoy; metocean buoy; lidar buoy; oceanographic buoy
    """),
    "vessel": listed("""
        trawler; coaster; barge; hopper barge; work barge; crane barge; feed barge; dinghy; skiff; rowing boat; kayak; canoe; sloop; ketch; yacht
        catamaran; houseboat; tug; pilot boat; lifeboat; ferry; car ferry; tanker; bulk carrier; container ship; reefer; freighter; dredger; lighter
        lightship; lightvessel; cutter; schooner; cruiser; patrol boat; crew boat; fishing boat; longliner; motorboat; inflatable; jet ski; hulk
        wreck; workboat; supply vessel; jack-up; jack-up barge; pontoon crane; survey vessel; research ship; training ship; tall ship; landing craft
        dive boat; tender; launch; narrowboat; sailing boat; day boat; speedboat; cabin cruiser; trimaran; shrimper; cable layer; buoy tender
        accommodation barge; fuel barge; deck barge; split hopper; pilot cutter; steam tug; paddle steamer; submarine; seaplane; amphibious truck
    """),
    "structure": listed("""
        pile; steel pile; sheet pile; wooden pile; pile cluster; monopile; transition piece; turbine; wind turbine; tidal turbine; jacket; jacket leg
        foundation; substation; converter platform; platform; drilling rig; gas platform; wellhead; flare tower; helideck; riser; met mast; lattice tower
        anemometer mast; pontoon; dolphin; mooring dolphin; breasting dolphin; fish cage; net cage; salmon pen; mussel raft; oyster rack; outfall
        sewage outfall; storm drain; intake; intake screen; cooling outlet; discharge pipe; pipeline; culvert; manifold; sluice; sluice gate; lock gate
        weir; dam face; spillway; flood gate; tide gate; dock gate; caisson; cofferdam; dry dock; slipway; boat ramp; boat lift; jetty; fuel jetty; pier
        wharf; quay wall; quay; mole; breakwater; groyne; sea wall; revetment; embankment; retaining wall; bridge; bridge pier; footbridge; rail bridge
        abutment; viaduct pier; aqueduct; lighthouse; range board; radar tower; water tower; chimney; camera pole; boathouse; pump house; hut
        bird hide; stilt house; diving platform; swimming raft; transformer; switch cabinet; junction box; battery container; solar array; power pylon
        exhaust stack; loading arm; crane; gantry crane; ship loader; conveyor; silo; gangway; landing stage; passenger float; fender pile
        pumping station; valve station; offshore platform; wave energy converter; floating turbine; service platform; suction bucket; test rig
        harbour crane; ferry terminal; link span; boat house; pilot station; control tower; signal mast; flood barrier; ice breaker pier; mole head
        pier head; breakwater head; landing; bathing platform; floating dock; floating bridge; sheet-pile wall; fender wall; tidal barrage
    """),
    "thing": listed("""
        shipping container; container; barrel; oil drum; drum; crate; pallet; gas bottle; tank; fuel tank; buoyancy tank; bollard; fender; net; ghost net
        trawl net; fish trap; lobster pot; crab pot; pipe; hose string; oil boom; turbidity curtain; silt screen; ROV; underwater drone; glider
        drone; mooring block; concrete block; sinker; tree trunk; fallen tree; log; anchor; anchor chain; cable drum
        car; van; tyre; mattress; fridge; tarpaulin; life jacket; life ring; surfboard; paddle board; generator; compressor; scaffold; ladder
        engine block; raft; life raft; oil slick; weather balloon; sonar fish; survey sled; crawler; bicycle; shopping trolley; propeller; rudder
    """),
    "nature": listed(
        "rock; reef; sandbank; boulder; islet; skerry; cliff; headland; sea stack; mussel bank; island; mud bank; cave; sea arch; ledge"
    ),
}
TARGET_NOUNS = tuple(noun for nouns in NOUNS.values() for noun in nouns)
COLOURS = listed(
    "red; green; blue; yellow; white; black; grey; orange; brown; silver; dark blue; light green;"
    " pale yellow; purple; turquoise"
)
PLACED = listed("""
    northern; southern; eastern; western; outer; inner; middle; nearest; farthest; second; third; next; last; first; main; northernmost; southernmost
    easternmost; westernmost; seaward; upstream; downstream; left-hand; right-hand
""")
ADJECTIVES: dict[str, tuple[str, ...]] = {
    "mark": listed("""
        striped; chequered; rusty; damaged; faded; unlit; lit; flashing; drifting; tall; small; big; old; new; conical; cylindrical; spherical; tilted
        leaning; overgrown; barnacled; unmarked; loose; temporary; solar-powered; red-and-white; yellow-and-black; fluorescent; battered; submerged
    """),
    "vessel": listed("""
        old; rusty; capsized; sunken; half-sunk; drifting; moored; anchored; listing; stranded; abandoned; derelict; burnt-out; wooden; steel
        fibreglass; small; big; disused; unmarked; unknown; suspicious; empty; loaded; overloaded; grounded; leaking; decommissioned; German; Dutch
        Norwegian; Danish; Polish; military; private; grey-hulled; white-hulled; blue-hulled; two-masted; laid-up; converted; flat-bottomed; battered
    """),
    "structure": listed("""
        old; new; rusty; damaged; collapsed; disused; abandoned; unfinished; decommissioned; tall; low; long; short; wide; narrow; round; square; steel
        concrete; wooden; stone; brick; floating; corroded; cracked; leaning; weathered; half-built; overgrown; derelict; painted; unpainted; lit; unlit
        large; small; three-legged; four-legged; covered; temporary; mossy; barnacled; hollow; submerged; repaired; reinforced; half-demolished
    """),
    "thing": listed("""
        floating; drifting; submerged; half-sunk; loose; dented; broken; rusty; old; big; small; large; lost; abandoned; stranded; unmarked; suspicious
        plastic; steel; wooden; rubber; aluminium; leaking; burst; torn; tangled; long; bent; heavy; oily; unidentified; striped; overturned; barnacled
    """),
    "nature": listed(
        "big; small; flat; sharp; outer; low; steep; white; black; bare; mossy; weedy; submerged; long; round; split; biggest; smallest"
    ),
}
TARGET_ADJECTIVES = tuple(
    dict.fromkeys((*COLOURS, *PLACED, *(word for words in ADJECTIVES.values() for word in words)))
)
WITH_LOOKS = listed("""
    broken; bent; missing; cracked; torn; rusty; faded; twisted; white; red; green; yellow; blue; black; orange; striped; damaged; loose; double; tall
    open; dented; new; collapsed
""")
WITH_PARTS: dict[str, tuple[str, ...]] = {
    "mark": listed(
        "top; band; lamp; topmark; light; cage; number; stripe; solar panel; bell; reflector; antenna; radar reflector; chain; label; lantern"
    ),
    "vessel": listed("""
        hull; deckhouse; funnel; mast; bow; stern; wheelhouse; crane; boom; railing; name board; stripe; awning; bowsprit; outboard; A-frame; deck; sail
        cabin roof; radar arch; gunwale
    """),
    "structure": listed("""
        ladder; roof; railing; platform; lamp; door; crane; fender; staircase; helideck; sign; window; mast; hatch; walkway; antenna; balcony; pipe
        gangway; handrail; brace; cladding; wall
    """),
    "thing": listed(
        "lid; rope; label; handle; stripe; net; strap; marking; tag; chain; valve; corner; flag; cover; frame; warning sign"
    ),
    "nature": listed("beacon; cross; cairn; pole; flag; perch; tree; hut; crack; cleft; marker"),
}
WITH_OTHERS = listed("""
    with two masts; with a green light; with solar panels; with a torn sail; with no lamp; with a hole in it; with birds on it; with weed on it
    with a tarpaulin over it; with twin engines; with graffiti; with a patch on it; with a flag; with barnacles; with scaffolding; with peeling paint
    with three legs; with a radar dome; with a number on it; with a wooden deck; with a satellite dish; with chains all round; with tyres on its sides
    with a red light on top; with a dent in it; with a cross on top; with no markings; with a broken rail; with a seal on top; with a wind vane
""")
WITH_PHRASES = (
    *WITH_OTHERS,
    *dict.fromkeys(
        f"with the {look} {part}"
        for look in WITH_LOOKS
        for parts in WITH_PARTS.values()
        for part in parts
    ),
)
STRUCTURE_PREFIXES = listed(
    "WTG ##; WTG-##; OSS #; OSS-#; TP ##; MP ##; MM-#; T-##; WT-##; MOB #; PLEM #; SBM #; FPSO @#;"
    " SPM #; BH-##; DP #"
)
MOVING_TARGETS = listed("""
    survey launch; drifting container; swimmer; seal; kayak; red kayak; canoe; dinghy; grey RIB; RIB; inflatable; rowing boat; sailing boat; yacht
    jet ski; surfer; windsurfer; kite surfer; paddle boarder; workboat; crew boat; dive tender; dive boat; pilot boat; tug; barge under tow; ferry
    water taxi; trawler; shrimper; longliner; fishing boat; speedboat; patrol boat; police launch; lifeboat; fire boat; dredger; hopper; landing craft
    whale; dolphin pod; porpoise; basking shark; turtle; loose buoy; drifting net; drifting raft; drifting tree; loose pontoon; ice floe; oil patch
    algae raft; ROV; glider; drone boat; life raft; drifting barrel; drifting log; loose mooring; drifter; surface float; hovercraft; amphibious car
    catamaran; trimaran; motor cruiser; tall ship; container ship; coaster; tanker; supply vessel; guard ship; training ship; customs cutter
    bunker boat; mussel boat; mail boat; duck boat; swan pedalo; rescue swimmer; open-water swimmer; narrowboat; day boat; cabin cruiser; launch
    pilot launch; harbour launch; salvage tug; towing barge; river barge; cable layer; buoy tender; coast guard cutter; rescue boat; research vessel
""")
CALLSIGN_PATTERNS = listed("""
    KX-##; contact #; contact ##; Sierra #; Sierra ##; MMSI #########; track #; track ##; target #; target ##; vessel ##; @@-##; @@##; call sign @@#
    Delta #; Alpha #; Bravo ##; Foxtrot #; Hotel #; Tango ##; Kilo #; Lima ##; bogey #; AIS ######; AIS #########; object ##; ID ####; id ###
    number ##; unit #; boat ##; swimmer #; diver #; tow ##; Zulu #; Whisky ##; @#; @##; @@@#; ###; ####; ##; tag ###; tag @##; track @#; contact @
    contact @@; runner #; skiff #; Echo ##; callsign Osprey #; callsign Tern ##; Red #; Blue ##; Viking #; Pelican ##; Falcon #; Guard ##; Rescue #
    Harbour #; Pilot ##; launch #; float ##; drifter ##; buoy-###; USV-#; USV ##; AUV #; AUV-##; glider ##; drone #; X-##; TRK-###; TGT ##; T##; S-##
    contact number #; MMSI ###-###-###; hull ###; pennant @##
""")
