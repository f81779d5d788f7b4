"""Parts that a camera looks at, sides, docking places, docking marks and data to send. All without
articles.
"""

from __future__ import annotations

from planner_ft.data.mission.synthetic.phrases import listed

FEATURES = listed("""
    valve; weld seam; weld; hatch; serial number; waterline; name plate; nameplate; hull number; load mark; draft marks; depth board; gauge board
    tide board; gauge; dial; pressure gauge; lamp; lantern; light; reflector; topmark; bell; anode; anode bracket; ladder; ladder rung; handrail
    railing; gangway; door; door lock; hinge; hinge pin; bolt; bolt row; flange; flange joint; gasket; seal; rubber seal; joint; expansion joint
    crack; cracked weld; rust patch; rust streak; dent; hole; paint; coating; marking; warning sign; sign; plaque; inscription; label
    identification plate; bar code; window; porthole; bridge window; vent; air vent; exhaust; funnel mark; rudder; propeller; propeller blade; shaft
    stern gland; bow; bow ramp; bow thruster; bulbous bow; anchor; anchor chain; hawse pipe; chain link; shackle; padeye; winch; winch drum
    crane hook; crane foot; jib; boom; block; pulley; cable tray; cable gland; junction box; bushing; insulator; busbar; switch; control panel; meter
    solar panel; antenna; radar; wind vane; anemometer; camera housing; speaker; fender; fender rack; tyre fender; bollard; cleat; rope; mooring line
    splice; knot; net; net panel; mesh tear; float line; feeding tube; bird net; brace; cross brace; strut; girder; bearing; bridge bearing; pile cap
    pile head; footing; scour pit; splash zone; marine growth; mussel bed; drip edge; drain; bilge outlet; outfall pipe; grating; screen; sluice
    gate seal; gate pivot; chain guide; roller; sheave; hose; hose coupling; manifold; pump; filter; tank lid; bung; vent cap; drain plug; spout
    nozzle; burner tip; flare tip; chimney cap; roof edge; gutter; chute; helideck edge; deck light; stern light; masthead; mast foot; rigging; shroud
    sail; boom end; tiller; outboard; keel; chine; transom; stern; name board; port of registry; licence number; registration; flag; life ring
    fire hose; extinguisher; notice board; lock; padlock; seal wire; tag; turbine blade; blade tip; nacelle; hub; yaw ring; bird's nest; leak
    oil stain; drip; wet patch; burn mark; scorch mark; impact mark; scratch; bulge; buckled plate; rivet; rivet row; plating; knee; rib; plank
    caulking
""")
FEATURE_PHRASES = listed("""
    with the red cap; on the upper deck; on the lower deck; on the port side; on the starboard side; with the yellow tag; on the stern; on the bow
    on the north leg; with the missing bolt; with the blue handle; on the roof; on the mast; with the crack in it; on the left pillar
    on the right pillar; with the loose nut; on the door; with the broken glass; on the second leg; on the crane; on the funnel; on the top rail
    with the white arrow; on the foredeck; on the quarterdeck; with the rusty rim; on the bottom rung; on the third frame; with the black tape
    with the bent rim; on the inner face; on the outer wall; on the middle span; with the double flange; on the hub; with the green plate
    on the west leg; on the seaward side; with the torn edge; on the wheelhouse; with the burnt edge; on the control box; on the handrail
    with the faded letters; with the spray paint on it; on the upper flange; on the lower bracket; with the wire round it; on the main pipe
    on the small hatch; with the rope on it; with the chipped paint; on the end wall; on the gable; with the square head; on the tail fin
    on the outer ring; with the plastic cover; on the waterline; with the brass ring; on the inlet; on the outlet; with the split seam
""")
SIDES = listed("""
    north; south; east; west; north-east; north-west; south-east; south-west; northern; southern; eastern; western; port; starboard; seaward; landward
    upstream; downstream; left; right; long; short; front; back; rear; inner; outer; inshore; offshore; windward; leeward; lee; weather; shoreward
    lower; upper; harbour; river; near; far; quay; channel; street; town; bow; stern; sunny; shaded; concrete; steel; wet; outside; inside; ebb; flood
    broad; narrow
""")
DOCK_SPOTS = listed("""
    berth 3; berth 7; berth 12; pontoon B; pontoon C; fuel jetty; fuel pontoon; fuel dock; north slip; south slip; visitor pontoon; pilot station
    lifeboat station; service quay; crane quay; coal quay; fish quay; ferry landing; ferry berth; customs quay; repair berth; winter berth
    lay-by berth; outer berth; inner berth; home berth; charging dock; charging station; charging berth; floating dock; dry dock; launch ramp; slipway
    boat hoist; boat lift; boathouse; mother ship; support vessel; barge ramp; stern ramp; well deck; landing stage; passenger pier; old pier
    west pier; east jetty; north jetty; research jetty; police jetty; harbour office; harbour steps; stone steps; lock wall; waiting berth
    mooring buoy 2; mooring dolphin 4; mooring post 9; finger pier; finger 6; slot 14; slip 22; bay 5; marina entrance; marina pontoon
    yacht club float; club jetty; work float; dive float; tender float; floating pontoon; wash-down berth; container terminal; ro-ro ramp
    oil terminal; tanker berth; bunkering berth; loading berth; workshop quay; university dock; museum quay; wooden dock; concrete quay; long jetty
    short pier; inner harbour; basin wall; canal dock; quay 4; quay A; dock 2; dock C; jetty 11; wharf 8; pier 39; pen 6; station 1; ramp B; cradle
    docking cradle; docking frame; garage
""")
DOCK_MARKS = listed("""
    green light; red light; white light; blue lamp; yellow lamp; green lantern; flashing lantern; strobe; LED bar; green light bar; light strip
    lamp pair; AprilTag; AprilTag 7; ArUco marker; QR code; checkerboard; checkered board; checkerboard marker; chess board; striped board
    striped pole; zebra board; white cross; yellow cross; red cross; orange triangle; black triangle; blue square; red square; white circle
    black circle; orange disc; yellow disc; bullseye; target board; dot pattern; dot grid; day-glo panel; orange panel; white panel; reflector strip
    reflector; reflective tape; red flag; pennant; windsock; orange ball; black ball; yellow buoy; white fender; red fender; tyre; painted bollard
    yellow bollard; arrow sign; white arrow; number plate; letter board; docking sign; docking light; lead marks; leading board; infrared beacon
    diamond mark; red diamond; white line; yellow stripe; retroreflector; hoop; ring mark; barber pole
""")
DATA_ITEMS = listed("""
    thermal images; depth soundings; yesterday's lidar scans; photos; stills; camera stills; video; footage; pass video; sonar log; sonar images
    drift log; track log; GPS track; tracks; logs; fault log; error log; event log; sensor log; battery log; depth grid; depth map; bathymetry
    point cloud; lidar scan; LiDAR point cloud; panorama; panorama frames; thermal series; thermal frames; thermal video; time-lapse; hotspot list
    hotspot picture; bushing video; weld photos; hull photos; hull video; pile photos; crack pictures; close-ups; snapshots; geotagged photos
    geo-snapshots; detection list; target list; contact list; sightings; map markers; map; cable track; cable positions; wave data; wind data
    weather log; tide readings; current profile; water temperatures; environment log; raw data; raw sonar files; raw video; compressed video
    thumbnails; preview images; yesterday's inspection report; survey data; survey lines; inspection pictures; inspection data
    damage photos; incident photos; incident video; evidence photos; night footage; morning pictures; last night's recordings; yesterday's logs
    this morning's soundings; today's photos; last week's scans; diagnostics log; diagnostic results; calibration data
    calibration file; camera feed; stereo pairs; radar plots; AIS log; radio log; position fixes; landing scan; clearance scan; glare-free shots
    name plate photo; serial numbers; plate numbers; OCR text; readings; meter readings; gauge readings; temperature log; temperature curve
    temperature readings; infrared images; IR clips; diver pictures; wreck images; wreck scan; net pictures; cage video; mooring photos; chain photos
    anode photos; scour data; seabed map; side-scan images; sidescan lines; multibeam data; echo sounder log; orbit video; orbit footage; pier video
    quay wall video; bolt pictures; whale pictures; bird counts; seal counts; oil spill images; search log; search images; mission log; mission data
    backup; alarm list; last clip; first clip; buffer clip
""")
