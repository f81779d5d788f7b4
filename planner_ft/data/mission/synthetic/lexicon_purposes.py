"""Why an operator asks for a task: infinitive clauses that ask for nothing themselves."""

from __future__ import annotations

from planner_ft.data.mission.synthetic.phrases import listed

PURPOSES: dict[str, tuple[str, ...]] = {
    "Diagnostics": listed("""
        to be on the safe side; to know that all is well; because of last night's knock; since the mast was struck; so that we can trust the data
        as the rules demand; to rule out a fault; after the service; because it was rough yesterday; before we trust you out there
    """),
    "Transit": listed("""
        to be out of the way; to make room for the ferry; to clear the berth; so the barge can leave; to be nearer the site; to get out of the swell
        to give the crane room; to be ready for the afternoon; to keep the channel open; so that the divers can work
    """),
    "FollowTarget": listed("""
        to see where it is bound; to learn where it goes; so that we don't lose it
        for safety; to keep it from being lost; for the rescue crew; to keep it in sight; so that the tug finds it; to learn who it belongs to
        so the coast guard knows where to go
    """),
    "KeepStation": listed("""
        to let the ferry pass; so the barge can leave; to give the divers time; until things calm down; to let the traffic clear
        while the bridge opens; to be at hand; so that the tug can pass; to act as a marker; while the crew changes over
    """),
    "DriftAudit": listed("""
        to see how the current sets; to see whether the current sets onto the cages; for the tide people; to learn the set at slack water
        to see where an oil spill would go; for the current model; to know which way a raft would go; to calibrate the model
        to see where the eddy carries you; for the lifeboat crew's drift charts
    """),
    "PerformOrbit": listed("""
        to see all of it; to see it from every side; so that no side is missed; to have every angle; to get the whole outline
        to see whether it still stands straight; for a model of it; to see what the storm has done; so we can build the model
        to see it from behind too
    """),
    "ParallelStructurePass": listed("""
        to see if the fender racks are still straight; to see whether the wall bulges; to see how far the crack runs; to see the whole face
        because a barge scraped it; to see whether the sheet piles lean; to judge the fenders; for the wall drawings; to see if the joints have opened
        after last week's collision
    """),
    "DockingApproach": listed("""
        for the night; to charge; so the batteries can charge; for maintenance; to be hauled out; before the storm; to be unloaded
        so that we can service you; for the weekend; to sit out the gale
    """),
    "VisualDockingApproach": listed("""
        since the GPS is poor there; because GPS is jammed; for the night; to charge; as the pontoon has shifted; because the float swings
        so that we can haul you out; to sit out the gale; since the berth moves; because the satellites are hidden there
    """),
    "HorizontalPanorama": listed("""
        to show the site; to show what the bay looks like; for the skyline model; to see what is moored around; to have the horizon on record
        so that we know the surroundings; to plan the works; for the visibility study; to see who else is out there; for the exhibition
    """),
    "ThermalHotspotLocalizer": listed("""
        to learn where it still smoulders; to see what runs hot; because it tripped last night; since there was a smell of burning
        to learn what overheats; to see where the heat escapes; because a bearing may be failing; to spot a bad contact; after the fire
        because the alarm went off
    """),
    "FeatureStare": listed("""
        to see whether it moves; to see whether the seal holds; to see whether it drips; to see how it vibrates; to see if it works loose
        to see whether it turns freely; so we can count the strokes; to see how far it opens; for the vibration people; to see whether water comes out
    """),
    "GlareFreeApproach": listed("""
        so that it can be read; because nobody can read it; since the sun is low; to get it clean on camera; so the letters show
        because the last ones were washed out; for the register; so that every digit shows; to make out the writing; since the water was like a mirror
    """),
    "ThermalTimeLapse": listed("""
        to see whether it cools down; to see how fast it heats up; to see whether it keeps warm; to catch the load peak; to see if it overheats
        to see the daily cycle; to see whether the insulation works; to see when the cooling kicks in; to know how it warms under load
        for the energy people
    """),
    "BoatLandingClearanceSweep": listed("""
        for the crew transfer; before the technicians step over; so the crew can land; to see if a boat fits in; because something fell there
        after the storm; for this afternoon's transfer; to see whether the bumpers are bent; because the ice may have bent it
        so that nobody gets hurt
    """),
    "BathymetryGridSurvey": listed("""
        for the dredgers; to see whether it has silted up; to see how much sand came in; for the new chart; to see if the ferry has enough water
        to see where it has scoured; to plan the dredging; for the keel clearance; to see how the bank has moved; so the deep boats can come in
    """),
    "SubseaCableTrack": listed("""
        to see whether the cable has come up out of its trench; to see if it is still buried; because it tripped; to see whether an anchor dragged it
        to learn where it lies; to see where it is exposed; for the as-laid chart; to see if it has shifted; after the trawler incident
        since nobody knows where it runs
    """),
    "SurveyTarget": listed("""
        to see what the storm has done; to see what shape it is in; because a boat hit it; to see whether it is still safe; before the repair
        to judge the damage; to see if it needs painting; to see whether anything is missing; for the damage claim; after the collision
    """),
    "SearchAndDetect": listed("""
        because it broke loose; since nobody knows where it went; because it has gone missing; before somebody runs into it
        as it was lost in the gale; so it can be salvaged; because the owner wants it back; so that the tug can fetch it
        as it is a danger to shipping; because it dragged its anchor
    """),
    "SmartDataHarvest": listed("""
        so the office can start; while the link is good; before the link drops; so that we can start processing; for the evening meeting
        since the bandwidth is poor; because the client is waiting; so the engineers can look; before the disk is full; for the analysts
    """),
    "AutoGenerateReportSummary": listed("""
        for the morning meeting; for the next watch; so that everybody knows; for the file; for the owner; because the auditors ask; for the log book
        to keep things tidy; for the steering group; so the client believes us
    """),
}
