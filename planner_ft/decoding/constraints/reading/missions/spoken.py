"""Words that certainly speak of a task."""

from __future__ import annotations

import re

SAYS = {
    title: re.compile(rf"\b(?:{words})", re.IGNORECASE)
    for title, words in {
        "Diagnostics": (
            r"self-?(?:test|check)|diagnostic|(?:sensor|health|system)s? (?:health"
            r" )?(?:check|test)|check(?:ed|ing)? (?:\w+ ){0,2}?"
            r"(?:sensor|camera|lens|gps)|(?:sensors?|cameras?|lens|gps)\b(?: \w+){0,4}"
            r" (?:checked|tested)"
        ),
        "AutoGenerateReportSummary": r"report|summar|writ(?:e|ten|ing) (?:\w+ ){0,2}?up\b|write-up",
        "SmartDataHarvest": r"upload|send|sent\b|transmit|beam",
        "BoatLandingClearanceSweep": (
            r"(?:lidar|sweep|swept|scan\w*|clearance)\b[^.;,]{0,40}\blanding|landing\b[^.;,]{0,30}\b(?:sweep|swept|scan|clearance)"
        ),
        "PerformOrbit": r"orbit|circl|(?:go|going|once|lap|way) a?round\b|\blaps?\b",
        "SurveyTarget": r"inspect|survey(?! of the depth| the depth| for depth)",
        "BathymetryGridSurvey": r"depths?\b|sounding|bathymetr|seabed|lawnmower",
        "HorizontalPanorama": r"panorama|panos?\b",
        "DriftAudit": r"drift(?! log| data| record)",
        "KeepStation": (
            r"keep(?:ing)? station|hold(?:ing)?\b|station.?keeping|stay(?:ing)?\b|loiter"
        ),
        "ThermalHotspotLocalizer": r"hott?est|hot ?-?spot",
        "ThermalTimeLapse": r"thermal (?:series|readings?|time)|time.?lapse|temperature series",
        "SubseaCableTrack": (
            r"track\w*\b[^.;,]{0,20}\bcable|cable (?:track|run|is tracked|has been tracked)"
        ),
        "DockingApproach": r"dock(?:ing|ed)?\b|berth(?:ing|ed)\b|alongside|moor(?:ed|ing up)?\b",
        "FeatureStare": r"film|footage|steady video|stare",
        "GlareFreeApproach": r"glare|reflection",
        "FollowTarget": r"follow(?:ing)? (?:the|contact|that|it|her)|shadow|tail\b|escort",
        "SearchAndDetect": r"find\b(?! the (?:hot|warm))|found\b|look(?:ing)? for|search|locat",
    }.items()
}
"""Words that certainly speak of a task."""
