"""How operators ask for thermal readings over a time and for the hottest spot."""

from __future__ import annotations

from planner_ft.data.mission.synthetic.bank_adjuncts import DURATION
from planner_ft.data.mission.synthetic.phrases import TaskPhrases, listed

THERMAL_HOTSPOT_LOCALIZER = TaskPhrases(
    imperatives=listed("""
        find the hottest spot on {target}; locate the hottest spot of {target}; pinpoint the hottest point of {target}
        look for hot spots on {target}; find the hot spot on {target}; search {target} for hotspots; scan {target} for hot spots
        localise the hotspot on {target}; do a hotspot scan of {target}; sweep {target} for the hottest spot; run a hotspot search on {target}
        find where {target} runs hottest; get the hottest point on {target}
        see where the heat sits on {target}; seek out the warmest spot on {target}; find the warmest part of {target}; pin down the hotspot at {target}
        thermal-sweep {target} for the hottest spot; mark the hottest spot on {target}; identify the hottest place on {target}
        track down the hot spot on {target}; establish which part of {target} is hottest; sniff out the hot spot on {target}
        sweep the thermal camera over {target} for the hottest spot; find what is overheating on {target}; find the heat source on {target}
        scan {target} with the thermal imager for its hottest spot; show me where {target} is overheating; work out where {target} is hottest
        point out the hottest bit of {target}; detect hotspots on {target}; localize thermal hotspots at {target}; pick out the hot spots at {target}
        hunt for hot spots on {target}; find the peak temperature spot on {target}; do a thermal hotspot sweep at {target}
        determine the hottest location on {target}; nail down the hottest point on {target}
    """),
    noun_phrases=listed("""
        the hottest spot on {target}; a hotspot scan of {target}; the hot spot on {target}; a thermal sweep of {target} for the hottest spot
        a hotspot search on {target}; the warmest point of {target}; a hotspot sweep at {target}; the location of the hottest spot on {target}
        a fix on the hottest part of {target}; a scan of {target} for hot spots; a hunt for hotspots on {target}; the hottest point of {target}
        a hotspot localisation at {target}
    """),
    gerunds=listed("""
        finding the hottest spot on {target}; locating the hot spot on {target}; scanning {target} for hotspots; pinpointing the hottest point of {target}
        looking for hot spots on {target}; sweeping {target} for the hottest spot; running a hotspot scan of {target}
        searching {target} for hot spots; localising the hotspot on {target}; hunting for hot spots at {target}
    """),
    adjuncts={
        "scan_width_degrees": listed("""
            scanning {scan_width_degrees} wide; with a {scan_width_degrees_compound} scan; over {scan_width_degrees}; sweeping {scan_width_degrees}
            {scan_width_degrees} scan width; with a scan {scan_width_degrees} wide; in a {scan_width_degrees_compound} sweep; scan {scan_width_degrees}
            with a sweep of {scan_width_degrees}; covering {scan_width_degrees}; across a width of {scan_width_degrees}
            on a {scan_width_degrees_compound} sweep
            with the scan set to {scan_width_degrees}
        """)
    },
    here_imperatives=listed("""
        find the hottest spot from where you are; scan for hot spots from right here; pinpoint the hottest spot from your present position
        sweep for the hottest spot without moving off
    """),
    bare_imperatives=listed("""
        find the hottest spot; locate the hottest spot; pinpoint its hottest point; find the hot spot; scan for hotspots; look for hot spots
        do a hotspot scan; run a hotspot sweep; find where it is hottest; localise the hotspot; search for its hottest spot; see what is hottest there
        pin down the hottest spot
    """),
    bare_noun_phrases=listed("""
        the hottest spot; a hotspot scan; its hottest point; a hotspot sweep; a hotspot search; the warmest spot there; a scan for hot spots
    """),
    bare_gerunds=listed("""
        finding the hottest spot; scanning for hotspots; pinpointing its hottest point; doing a hotspot scan; looking for hot spots; locating the hottest spot
        running a hotspot sweep
    """),
    valued_imperatives=listed("""
        do a {scan_width_degrees_compound} hotspot scan of {target}; scan {scan_width_degrees} for the hottest spot on {target}
        sweep {scan_width_degrees} across {target} for hot spots; do a {scan_width_degrees_compound} sweep for its hottest spot
    """),
    valued_noun_phrases=listed("""
        a {scan_width_degrees_compound} hotspot scan of {target}; a {scan_width_degrees_compound} sweep of {target} for the hottest spot
        a {scan_width_degrees_compound} hotspot scan
    """),
)

THERMAL_TIME_LAPSE = TaskPhrases(
    imperatives=listed("""
        take a thermal time-lapse of {target}; log the temperature of {target} over time; shoot a thermal time lapse of {target}
        take repeated thermal readings of {target}; record a thermal series of {target}; make a thermal time series of {target}
        keep taking thermal readings of {target}; monitor the temperature of {target} with the thermal camera; run a thermal time-lapse at {target}
        watch {target} with the thermal camera and log the readings; log thermal readings at {target}; track how the temperature of {target} changes
        measure {target} with the thermal camera at regular intervals; take periodic thermal readings of {target}
        record how {target} warms and cools over time; do a thermal series on {target}; capture a run of thermal frames of {target}
        gather a temperature series of {target}; stay at {target} and keep logging its temperature; hold at {target} and take thermal readings
        set up a thermal time-lapse on {target}; do thermal readings of {target} at intervals; follow the temperature of {target} over time
        collect a series of thermal images of {target}; time-lapse {target} in thermal; repeat thermal measurements of {target}
        keep the infrared camera on {target} and log its temperature; sample the temperature of {target} in infrared time after time
        hold off {target} and log thermal readings; record thermal values of {target} over a while; put the thermal imager on {target} for a time-lapse
        log heat readings from {target} over a time; make an infrared time-lapse of {target}; take IR readings of {target} at intervals
        trend the temperature of {target}; keep a thermal log of {target}; keep an infrared record of {target} going
        shoot an IR time-lapse of {target}; chart the temperature of {target} over time; take thermal shots of {target} one after another
    """),
    noun_phrases=listed("""
        a thermal time-lapse of {target}; a thermal series of {target}; thermal readings of {target} over time; a temperature log of {target}
        a thermal time series of {target}; periodic thermal readings of {target}; a series of thermal images of {target}; an infrared time-lapse of {target}
        repeated thermal measurements of {target}; a thermal log of {target}; a temperature series at {target}; an IR series of {target}
        a run of thermal readings at {target}; a temperature trend of {target}
    """),
    gerunds=listed("""
        taking a thermal time-lapse of {target}; logging the temperature of {target} over time; recording a thermal series of {target}
        taking repeated thermal readings of {target}; monitoring the temperature of {target} in thermal; shooting a thermal time-lapse at {target}
        collecting thermal readings at {target}; keeping a thermal log of {target}; making an infrared time-lapse of {target}
        taking thermal readings of {target} at intervals
    """),
    adjuncts={
        "duration": DURATION,
        # The value stands after "every" or "each" ("every minute"), or as an attribute.
        "interval": listed("""
            every {interval}; one every {interval}; a reading every {interval}; one reading each {interval}
            a frame every {interval}; at {interval_compound} intervals; a measurement every {interval}; once every {interval}
            with a {interval_compound} interval; sampling every {interval}; one frame each {interval}; each {interval}; repeating every {interval}
            on a {interval_compound} interval; a sample every {interval}
        """),
    },
    here_imperatives=listed("""
        take a thermal time-lapse from where you are; log thermal readings over time right here; run a thermal series from your present position
        take periodic thermal readings without moving off
    """),
    bare_imperatives=listed("""
        take a thermal time-lapse; record a thermal series; log the temperature over time; take repeated thermal readings; do a thermal time series
        keep taking thermal readings; log its temperature over time; run a thermal time-lapse; take thermal readings at intervals; shoot an IR time-lapse
        make an infrared time-lapse; take periodic thermal measurements; monitor its temperature in thermal
    """),
    bare_noun_phrases=listed("""
        a thermal time-lapse; a thermal series; thermal readings over time; a temperature log; a thermal time series; periodic thermal readings
        an infrared time-lapse
    """),
    bare_gerunds=listed("""
        taking a thermal time-lapse; recording a thermal series; logging the temperature over time; taking repeated thermal readings
        taking thermal readings at intervals; shooting an IR time-lapse; running a thermal time-lapse
    """),
    valued_imperatives=listed("""
        take thermal readings of {target} every {interval} for {duration}; take a thermal reading of {target} every {interval}
        do {duration} of thermal readings of {target}; log thermal readings of {target} for {duration}, one every {interval}
        take thermal readings every {interval} for {duration}; shoot a thermal frame of {target} every {interval} for {duration}
        measure {target} in thermal every {interval} over {duration}; log {duration} of thermal readings; take a thermal frame every {interval}
        watch the temperature of {target} in infrared for {duration}; do a {duration_compound} thermal time-lapse of {target}
        read the temperature of {target} by thermal camera every {interval}
    """),
    valued_noun_phrases=listed("""
        thermal readings of {target} every {interval} for {duration}; {duration} of thermal readings at {target}
        a {duration_compound} thermal series of {target}; a {duration_compound} thermal time-lapse of {target}; a thermal frame of {target} every {interval}
        thermal readings every {interval} for {duration}; {duration} of thermal readings; a {duration_compound} thermal series
    """),
)

BANK_THERMAL = {
    "ThermalHotspotLocalizer": THERMAL_HOTSPOT_LOCALIZER,
    "ThermalTimeLapse": THERMAL_TIME_LAPSE,
}
