"""How operators ask for checks, searches, uploads and reports."""

from __future__ import annotations

from planner_ft.data.mission.synthetic.phrases import TaskPhrases, listed

DIAGNOSTICS = TaskPhrases(
    imperatives=listed("""
        run diagnostics; run a self-test; check your sensors; do a health check of the sensors; run a sensor check; test your sensors
        do a self check; check GPS and cameras; make sure your sensors are working; run the system check; do a full sensor check
        perform a sensor health check; run a health check; carry out diagnostics; check that the cameras and the GPS work
        verify your sensors; see that all sensors are healthy; do the sensor diagnostics; check cameras, horizon and lens
        test the cameras and the GPS; run through your sensor checks; give your sensors a check; run your built-in test; do a BIT
        check yourself over; have a look at your own health; check that the lens is clean and the GPS is good; go through the sensor checklist
        run a diagnostic on all sensors; do a preflight check of the sensors; make sure all your kit works; check your instruments
        execute the diagnostics; do a systems check; do your checks; check the lens and the horizon; check that everything aboard works
        prove the sensors; run the pre-departure sensor test; give yourself a once-over, sensors and all; make a status check of the sensors
        confirm by self-test that the sensors are fit; check the state of your sensors; do a quick sensor test
    """),
    noun_phrases=listed("""
        diagnostics; a sensor check; a self-test; a health check of the sensors; a sensor health check; a full diagnostic; a systems check
        a check of cameras and GPS; a self check; a diagnostic run; a test of all sensors; a pre-departure check; a quick sensor test
        a check of your instruments; a built-in test; a sensor diagnostic; a lens and GPS check
    """),
    gerunds=listed("""
        running diagnostics; checking your sensors; running a self-test; testing the sensors; doing a health check; doing a sensor check
        checking the cameras and the GPS; going through your checks; verifying your sensors; checking yourself over
        completing the diagnostics; running the sensor test
    """),
)

SEARCH_AND_DETECT = TaskPhrases(
    imperatives=listed("""
        find {target_description}; locate {target_description}; look for {target_description}; search for {target_description}
        go and find {target_description}; hunt for {target_description}; track down {target_description}; seek out {target_description}
        see if you can find {target_description}; try to locate {target_description}; scout for {target_description}
        do a search for {target_description}; run a search for {target_description}; go looking for {target_description}
        detect {target_description}; get eyes on {target_description}; pick out {target_description}; find me {target_description}
        make a search for {target_description}; find out where {target_description} is; find and confirm {target_description}
        pinpoint {target_description}; cast about for {target_description}; keep looking until you find {target_description}
        sweep the area for {target_description}; scan the water for {target_description}; comb the area for {target_description}
        search the area for {target_description}; have a look for {target_description}; go hunting for {target_description}
        discover where {target_description} has got to; establish where {target_description} is; spot {target_description} for us
        get a position on {target_description}; get a fix on {target_description}; start a search for {target_description}
        work out where {target_description} is; look around for {target_description}; sniff out {target_description}
        get {target_description} located; conduct a search for {target_description}; search out {target_description}
        trace {target_description}; try and spot {target_description}; go and see where {target_description} lies
    """),
    noun_phrases=listed("""
        a search for {target_description}; the location of {target_description}; the position of {target_description}
        a hunt for {target_description}; an area search for {target_description}; a look-out for {target_description}
        a sighting of {target_description}; a position fix on {target_description}; a search and detect for {target_description}
        a sweep of the area for {target_description}; a scout round for {target_description}; a detection of {target_description}
    """),
    gerunds=listed("""
        finding {target_description}; locating {target_description}; searching for {target_description}; looking for {target_description}
        hunting for {target_description}; tracking down {target_description}; seeking out {target_description}
        scouting for {target_description}; running a search for {target_description}; getting a fix on {target_description}
        detecting {target_description}
    """),
)

SMART_DATA_HARVEST = TaskPhrases(
    imperatives=listed("""
        upload {target_list}; send {target_list}; transmit {target_list}; send us {target_list}; send up {target_list}
        push {target_list} up; beam {target_list} back; send me {target_list}; get {target_list} up to us; offload {target_list}
        uplink {target_list}; relay {target_list}; pass {target_list} up the link; send {target_list} ashore; forward {target_list}
        transfer {target_list}; deliver {target_list} over the link; stream {target_list} back to base; put {target_list} on the server
        upload {target_list} to the office; send {target_list} to the control room; ship {target_list} up; dump {target_list} to shore
        squirt {target_list} down the link; wire {target_list} over; use the link to send {target_list}; get {target_list} off the boat
        harvest and send {target_list}; upload to shore {target_list}; start uploading {target_list}; start sending {target_list}
        put {target_list} through to base; send {target_list} through; submit {target_list}; feed {target_list} back over the radio link
        radio {target_list} back; send {target_list} in; sync {target_list} to shore; push out {target_list}; send off {target_list}
        upload for us {target_list}; make an upload of {target_list}; send back {target_list}
    """),
    noun_phrases=listed("""
        an upload of {target_list}; a transmission of {target_list}; a data transfer of {target_list}; an uplink of {target_list}
        a data push with {target_list}; a transfer ashore of {target_list}; an upload to base of {target_list}; an offload of {target_list}
        a prioritised upload of {target_list}; a data harvest with {target_list}; a data dump of {target_list}
    """),
    gerunds=listed("""
        uploading {target_list}; sending {target_list}; transmitting {target_list}; sending us {target_list}; pushing {target_list} up
        transferring {target_list}; offloading {target_list}; sending up {target_list}; getting {target_list} ashore
        relaying {target_list}; sending {target_list} in
    """),
    bare_imperatives=listed("""
        upload your data; send us your data; upload what you have recorded; transmit everything you have; send the lot ashore
        offload your recordings; upload the data by priority; send what you collected; push your data up; get your data ashore
        send up whatever you gathered; do a data upload; run a data harvest; transmit your data; upload everything; send it all in
        start the data upload; send all of it to base; uplink everything aboard
    """),
    bare_noun_phrases=listed("""
        a data upload; an upload of your data; a data transfer to shore; a data harvest; a transmission of everything you have
        an upload by priority; a full data offload
    """),
    bare_gerunds=listed("""
        uploading your data; sending us your data; transmitting everything you have; offloading your recordings; sending it all in; doing the data upload
    """),
)

AUTO_GENERATE_REPORT_SUMMARY = TaskPhrases(
    imperatives=listed("""
        report; report back; write a report; write it up; give me a summary; summarise what you saw
        summarize the findings; tell us what you found; tell me what you saw; make a report; put together a report; compile a report
        compile a summary; write up the results; draft a mission report; prepare a report; generate a report; produce a summary report
        report your findings; report what you find; let us have a report; write the whole thing up; sum it all up; give us a write-up
        brief us on what you saw; give me a debrief; make a short report of it; do a report; do the write-up; tell control what you saw
        summarise the results; put it all in a report; write a summary of the mission; file a report; log it in a report
        report on the outcome; give a short report; tell me about it in a report; write me a report; draw up a report; report to us
        deliver a mission summary; wrap it up in a report; recap what you found; tell the office what turned up
        put the observations into a report; let me have a summary; report on what you saw; write down the findings for us
    """),
    noun_phrases=listed("""
        a report; a summary; a mission report; a short report; a write-up; a summary of the findings; a report on what you saw
        a written report; a summary report; a debrief; a mission summary; a report of your observations; a brief summary of it all
        a write-up of the results; a final report; an automatic report; a recap of the findings
    """),
    gerunds=listed("""
        reporting; writing a report; summarising what you saw; writing it up; reporting back; compiling the report; making a report
        writing up the findings; telling us what you found; summing it all up; preparing the summary; drafting a mission report
    """),
)

BANK_DATA = {
    "Diagnostics": DIAGNOSTICS,
    "SearchAndDetect": SEARCH_AND_DETECT,
    "SmartDataHarvest": SMART_DATA_HARVEST,
    "AutoGenerateReportSummary": AUTO_GENERATE_REPORT_SUMMARY,
}
