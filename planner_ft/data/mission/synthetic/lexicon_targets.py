"""What a boat is sent to: nouns, adjectives, "with ..." phrases, things that move, call signs and names. All without articles."""

from __future__ import annotations

from planner_ft.data.mission.synthetic.phrases import listed

TARGET_NOUNS = listed("""
    buoy; can buoy; nun buoy; wreck buoy; mooring buoy; cardinal buoy; fairway buoy; weather buoy; wave buoy; marker buoy; spar buoy; data buoy
    fender; pile; steel pile; sheet pile; wooden pile; pile cluster; monopile; transition piece; turbine; wind turbine; tidal turbine; jacket
    jacket leg; foundation; substation; converter platform; platform; drilling rig; gas platform; wellhead; flare tower; helideck; riser; met mast
    anemometer mast; wreck; trawler; coaster; barge; hopper barge; work barge; crane barge; feed barge; pontoon; raft; dinghy; skiff; rowing boat
    kayak; canoe; sloop; ketch; yacht; catamaran; houseboat; tug; pilot boat; lifeboat; ferry; car ferry; tanker; bulk carrier; container ship; reefer
    freighter; dredger; lighter; lightship; lightvessel; cutter; schooner; cruiser; patrol boat; crew boat; fishing boat; longliner; motorboat
    inflatable; jet ski; paddle board; hulk; hull; stern; keel; mast; funnel; anchor; anchor chain; chain locker; rudder; propeller
    shipping container; container; reefer container; skip; barrel; oil drum; drum; crate; pallet; gas bottle; tank; fuel tank; septic tank
    buoyancy tank; bollard; dolphin; mooring dolphin; breasting dolphin; fish cage; cage; net cage; salmon pen; mussel raft; oyster rack; lobster pot
    crab pot; net; ghost net; seine net; trawl net; fish trap; feeding pipe; outfall; sewage outfall; storm drain; intake; intake screen
    cooling outlet; discharge pipe; pipe; pipeline; culvert; manifold; hydrant; sluice; sluice gate; lock gate; weir; dam face; spillway; flood gate
    tide gate; dock gate; caisson; cofferdam; dry dock; slipway; boat ramp; boat lift; jetty; fuel jetty; pier; wharf; quay wall; quay; mole
    breakwater; groyne; sea wall; revetment; embankment; retaining wall; bridge; bridge pier; footbridge; rail bridge; abutment; viaduct pier
    aqueduct; lighthouse; beacon; leading light; sector light; day mark; perch; range board; radar tower; lattice tower; water tower; chimney
    tide gauge; tide staff; current meter; wave rider; hydrophone; sensor node; camera pole; solar float; ROV; underwater drone; glider; sonar fish
    drone; drifter; mooring block; sinker; concrete block; boulder; rock; reef; sandbank; island; cave mouth; cliff; tree; tree trunk; fallen tree
    log; branch raft; root stock; car; van; bicycle; shopping trolley; tyre; mattress; fridge; piano; statue; bathtub; tarpaulin; tent; mannequin
    life jacket; life ring; surfboard; buoy chain; crane; gantry crane; ship loader; conveyor; silo; pump house; boathouse; hut; hide; bird hide
    stilt house; diving platform; swimming raft; water slide; transformer; transformer barge; generator; switch cabinet; junction box
    battery container; solar array; cable drum; cable pylon; power pylon; exhaust stack; boiler; compressor; chiller; heat exchanger; valve station
    pumping station; loading arm; hose string; oil boom; turbidity curtain; sediment trap; silt screen; scaffold; ladder; gangway; fender pile
    mud berth; landing stage; passenger float; tender; amphibious truck; airboat; seaplane; aircraft wing; engine block
""")
TARGET_ADJECTIVES = listed("""
    red; green; blue; yellow; white; black; grey; orange; brown; silver; purple; pink; turquoise; striped; chequered; spotted; rusty; corroded
    painted; unpainted; broken; cracked; bent; dented; damaged; twisted; collapsed; capsized; sunken; half-sunk; burnt; charred; leaking; overturned
    tilted; leaning; listing; stranded; abandoned; derelict; old; new; ancient; disused; unfinished; half-built; decommissioned; big; small; huge
    tiny; tall; low; long; short; wide; narrow; round; square; flat; hollow; double; twin; three-legged; four-legged; single; hexagonal; conical
    cylindrical; floating; submerged; drifting; moored; anchored; loose; adrift; untended; steel; wooden; concrete; stone; plastic; rubber; aluminium
    fibreglass; iron; brick; tarred; galvanised; bare; mossy; weedy; overgrown; barnacled; slimy; muddy; northern; southern; eastern; western; outer
    inner; middle; upper; lower; left-hand; right-hand; seaward; nearest; farthest; second; third; next; last; first; main; spare; unlit; lit
    flashing; shiny; faded; pale; dark; dull; bright; fluorescent; camouflaged; tethered; covered; open; closed; locked; empty; loaded; overloaded
    German; Dutch; Norwegian; Danish; Polish; military; private; municipal; suspicious; unknown; unmarked; numbered; crooked; wobbly; patched; torn
    frayed; oily; sooty
""")
WITH_PHRASES = listed("""
    with the broken ladder; with a yellow top; with a red stripe; with two masts; with a green light; with the cracked lamp; with a white cross
    with the bent mast; with solar panels; with a torn sail; with the blue roof; with a missing hatch; with a black band; with the rusty chain
    with three legs; with a radar dome; with a broken window; with the open door; with a helideck; with the long jib; with orange fenders
    with a wooden deck; with the smashed bow; with a dented side; with a number on it; with the torn net; with a loose chain; with an antenna
    with a flashing light; with the tall chimney; with no lamp; with a flat roof; with peeling paint; with a hole in it; with the crooked pole
    with yellow stripes; with a seal on top; with birds on it; with a cage round it; with weed on it; with a tarpaulin over it; with the fallen crane
    with twin engines; with an outboard; with a blue stripe; with the reflector; with a white hull; with a red funnel; with the glass dome
    with the striped pole; with a double roof; with a sunken stern; with the crane on deck; with the yellow ladder; with a round top
    with the square base; with a green stripe; with barnacles; with a bell; with the topmark; with two lamps; with the wind vane; with a broken rail
    with the missing rung; with the spray marks; with a steel frame; with a concrete foot; with a satellite dish; with the loose fender
    with the cut rope; with the tangled line; with the split plank; with graffiti; with a patch on it; with the rubber edge; with the plastic sheet
    with a flag; with the torn flag; with the warning sign; with the leaking pipe; with the old winch; with chains all round; with a big dent
    with a cracked foot; with scaffolding; with the stone base; with tyres on its sides; with a red light on top; with the blue tarp
""")
MOVING_TARGETS = listed("""
    survey launch; drifting container; swimmer; seal; kayak; red kayak; canoe; dinghy; grey RIB; RIB; inflatable; rowing boat; sailing boat; yacht
    jet ski; surfer; windsurfer; kite surfer; paddle boarder; workboat; crew boat; dive tender; dive boat; pilot boat; tug; barge under tow; ferry
    water taxi; trawler; shrimper; longliner; fishing boat; speedboat; patrol boat; police launch; lifeboat; fire boat; dredger; hopper; landing craft
    whale; dolphin pod; porpoise; basking shark; turtle; loose buoy; drifting net; drifting raft; drifting tree; loose pontoon; ice floe; oil patch
    algae raft; ROV; glider; drone boat; life raft; drifting barrel; drifting log; loose mooring; drifter; surface float; hovercraft; amphibious car
    catamaran; trimaran; motor cruiser; tall ship; container ship; coaster; tanker; supply vessel; guard ship; training ship; customs cutter
    bunker boat; mussel boat; mail boat; duck boat; swan pedalo; rescue swimmer; open-water swimmer
""")
CALLSIGN_PATTERNS = listed("""
    KX-##; contact #; contact ##; Sierra #; Sierra ##; MMSI #########; track #; track ##; target #; target ##; vessel ##; @@-##; @@##; call sign @@#
    Delta #; Alpha #; Bravo ##; Foxtrot #; Hotel #; Tango ##; Kilo #; Lima ##; bogey #; AIS ######; AIS #########; object ##; ID ####; id ###
    number ##; unit #; boat ##; swimmer #; diver #; tow ##; Zulu #; Whisky ##; @#; @##; @@@#; ###; ####; ##; tag ###; tag @##; track @#; contact @
    contact @@; runner #; skiff #; Echo ##; callsign Osprey #; callsign Tern ##; Red #; Blue ##; Viking #; Pelican ##; Falcon #; Guard ##; Rescue #
    Harbour #; Pilot ##; launch #; float ##; drifter ##; buoy-###; USV-#; USV ##; AUV #; AUV-##; glider ##; drone #; X-##; TRK-###; TGT ##; T##; S-##
    contact number #; MMSI ###-###-###; hull ###; pennant @##
""")
PROPER_NAMES = listed("""
    Hilda; Marit; Torunn; Sonja; Elsa; Mette; Sula; Brage; Oryx; Petra; Ingrid; Astrid; Freya; Solveig; Gerda; Wilma; Berta; Klara; Lotte; Trude
    Agnes; Dagmar; Ragna; Vesta; Juno; Pallas; Ceres; Hebe; Io; Titan; Rhea; Dione; Ariel; Oberon; Puck; Triton; Nereid; Calypso; Atlas; Pandora
    Janus; Mimas; Phoebe; Castor; Pollux; Trongate; Bergfald; Nordfjord; Vester; Skarvik; Holmsund; Tarnholm; Kestrel; Marrow Point; Gull Rock; Saltby
    Thornwick; Graveney; Mucklehead; Hexton; Cardew; Blythe; Ferris; Auckley; Ruddock; Penhallow; Tregarth; Lanyon; Morwen; Kerrow; Zennor; Pendower
    Brannoch; Lochinver; Stornaway; Ardmore; Corrie; Tolsta; Barvas; Shawbost; Varberg; Halden; Larvik; Mandal; Egersund; Haugen; Skagen; Thisted
    Esbjerg; Husum; Norden; Emden; Jade; Weser; Warnow; Rega; Ustka; Liepaja; Parnu; Haapsalu; Kotka; Old Tom; Grey Lady; Blue Heron; Red Fox
    White Swan; Sea Lark; Sandpiper; Curlew; Dunlin; Merlin; Peregrine; Cormorant; Gannet; Puffin; Guillemot; Fulmar; Petrel; Meridian; Horizon
    Vanguard; Resolve; Endurance; Patience; Fortune; Liberty; Nimbus; Cirrus; Stratus; Polaris; Vega; Altair; Sirius; Arcturus; Rigel; Capella
    Bluebell; Thistle; Heather; Foxglove; Bramble; Juniper; Rowan; Aspen; Willow; Hawthorn; Larch; Maple; Basil; Rufus; Otto; Anton; Casimir; Leopold
    Magnus; Sigurd; Haakon; Olaf; Gustav; Knut; Sven; Björn; Åse; Øystein; Jørgen; Märta; Jürgen; Zoë; Inês; João; Renée; Chloé; Matteo; Giulia; Pilar
    Dolores; Kenji; Aiko; Mei Lin; Thornbury; Ashdown; Kingsway; Millgate; Northgate; Ropewalk; Tidewell; Deepwater; Longreach; Shingle End
    Cold Harbour; Windy Ridge; Eagle Ness; Raven Holm; Duke Street; Prince Albert; Queen Bee; Lord Nelson; Saint Olaf; Santa Rosa; Don Pedro; Mary Ann
    Lady Jane; Big Bertha; Little John; Moby; Nemo; Goliath; Samson
""")
