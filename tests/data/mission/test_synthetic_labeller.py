"""Each labelling rule, one by one: which tasks ordered intents stand for, and with which
positions.
"""

from planner_ft.data.mission.synthetic.intents import PLACE_TASKS, Intent, Target
from planner_ft.data.mission.synthetic.labeller import label

UNRESOLVED = [-99, -99]
MAST = Target(1, "met mast", (120, -35))
BARGE = Target(2, "barge Elsa")
POINT = Target(3, None, (45, 10))
CONTACT = Target(4, identity="contact 4", movable=True)


def plan(*intents: Intent) -> list[tuple[str, dict]]:
    return [(planned.title, planned.parameters) for planned in label(intents)]


def titles(*intents: Intent) -> list[str]:
    return [title for title, _parameters in plan(*intents)]


def test_described_target_is_searched_once_before_its_first_use():
    assert plan(
        Intent("SurveyTarget", BARGE),
        Intent("Diagnostics"),
        Intent("SurveyTarget", BARGE, {"radius": 9}),
    ) == [
        ("SearchAndDetect", {"target_description": "barge Elsa"}),
        ("SurveyTarget", {"target_position": UNRESOLVED}),
        ("Diagnostics", {}),
        ("SurveyTarget", {"target_position": UNRESOLVED, "radius": 9}),
    ]


def test_a_command_that_says_find_gets_no_second_search():
    assert titles(Intent("SearchAndDetect", BARGE), Intent("KeepStation", BARGE)) == [
        "SearchAndDetect",
        "Transit",
        "KeepStation",
    ]


def test_target_with_coordinates_is_searched_only_on_request():
    assert titles(Intent("SurveyTarget", MAST)) == ["SurveyTarget"]
    assert titles(Intent("SearchAndDetect", MAST)) == ["SearchAndDetect"]


def test_after_a_search_the_transit_is_unresolved():
    assert plan(Intent("PerformOrbit", BARGE, {"radius": 20})) == [
        ("SearchAndDetect", {"target_description": "barge Elsa"}),
        ("Transit", {"target_position": UNRESOLVED}),
        ("PerformOrbit", {"center": UNRESOLVED, "radius": 20}),
    ]


def test_every_place_task_gets_its_transit():
    assert len(PLACE_TASKS) == 10
    for title in PLACE_TASKS:
        assert titles(Intent(title, POINT)) == ["Transit", title]
        assert plan(Intent(title, POINT))[0][1] == {"target_position": [45, 10]}


def test_no_transit_without_a_place_or_at_the_place_already():
    assert titles(Intent("KeepStation"), Intent("DriftAudit")) == ["KeepStation", "DriftAudit"]
    assert titles(Intent("KeepStation", POINT), Intent("HorizontalPanorama", POINT)) == [
        "Transit",
        "KeepStation",
        "HorizontalPanorama",
    ]
    assert titles(Intent("Transit", POINT), Intent("KeepStation", POINT)) == [
        "Transit",
        "KeepStation",
    ]
    assert titles(Intent("SurveyTarget", MAST), Intent("PerformOrbit", MAST)) == [
        "SurveyTarget",
        "PerformOrbit",
    ]


def test_a_place_left_and_come_back_to_gets_a_transit_again():
    there_and_back = plan(
        Intent("KeepStation", BARGE), Intent("KeepStation", POINT), Intent("KeepStation", BARGE)
    )
    assert [title for title, _ in there_and_back] == [
        "SearchAndDetect",
        "Transit",
        "KeepStation",
        "Transit",
        "KeepStation",
        "Transit",
        "KeepStation",
    ]
    assert there_and_back[5][1] == {"target_position": UNRESOLVED}


def test_reports_checks_and_uploads_do_not_move_the_vehicle():
    between = [
        Intent("KeepStation", POINT),
        Intent("Diagnostics"),
        Intent("AutoGenerateReportSummary"),
        Intent("SmartDataHarvest"),
        Intent("DriftAudit", POINT),
    ]
    assert titles(*between) == [
        "Transit",
        "KeepStation",
        "Diagnostics",
        "AutoGenerateReportSummary",
        "SmartDataHarvest",
        "DriftAudit",
    ]


def test_area_and_track_leave_their_place():
    assert titles(Intent("BathymetryGridSurvey", POINT), Intent("KeepStation", POINT)) == [
        "BathymetryGridSurvey",
        "Transit",
        "KeepStation",
    ]
    assert titles(Intent("SubseaCableTrack", POINT), Intent("HorizontalPanorama", POINT)) == [
        "SubseaCableTrack",
        "Transit",
        "HorizontalPanorama",
    ]


def test_self_going_tasks_have_a_transit_only_where_the_command_says_go():
    for title in ("SurveyTarget", "BathymetryGridSurvey", "SubseaCableTrack"):
        assert titles(Intent(title, POINT)) == [title]
        assert titles(Intent("Transit", POINT), Intent(title, POINT)) == ["Transit", title]


def test_go_to_a_described_place_searches_it_first():
    assert plan(Intent("Transit", BARGE))[1] == ("Transit", {"target_position": UNRESOLVED})


def test_positions_stand_under_the_name_that_the_task_has_for_them():
    assert plan(Intent("BathymetryGridSurvey", POINT)) == [
        ("BathymetryGridSurvey", {"center": [45, 10]})
    ]
    assert plan(Intent("SubseaCableTrack", POINT)) == [("SubseaCableTrack", {"start": [45, 10]})]
    assert plan(Intent("DockingApproach", Target(9, None, (6, -3), spot=True))) == [
        ("DockingApproach", {"goal_position": [6, -3]})
    ]


def test_ids_are_followed_without_search():
    assert plan(Intent("FollowTarget", CONTACT)) == [("FollowTarget", {"target_id": "contact 4"})]
    seen = Target(4, None, (55, -12), identity="contact 4", movable=True)
    assert plan(Intent("FollowTarget", seen)) == [
        ("FollowTarget", {"target_id": "contact 4", "target_position": [55, -12]})
    ]


def test_described_things_are_searched_and_followed_unresolved():
    assert plan(Intent("FollowTarget", Target(5, "red kayak", movable=True)))[1] == (
        "FollowTarget",
        {"target_position": UNRESOLVED},
    )


def test_docks_are_never_searched():
    assert plan(Intent("DockingApproach", Target(9, "berth 7", spot=True))) == [
        ("DockingApproach", {"goal_position": UNRESOLVED})
    ]
    assert plan(Intent("VisualDockingApproach", None, {"target_feature": "white cross"})) == [
        ("VisualDockingApproach", {"target_feature": "white cross"})
    ]


def test_return_goes_home_and_leaves_the_place():
    assert plan(Intent("KeepStation", POINT), Intent("Transit", home=True))[-1] == (
        "Transit",
        {"target_position": [0, 0]},
    )
    assert titles(Intent("Transit", home=True), Intent("VisualDockingApproach")) == [
        "Transit",
        "VisualDockingApproach",
    ]
    assert titles(
        Intent("KeepStation", POINT), Intent("Transit", home=True), Intent("KeepStation", POINT)
    ) == ["Transit", "KeepStation", "Transit", "Transit", "KeepStation"]


def test_what_lies_where_the_vehicle_is_needs_neither_search_nor_transit():
    landing = Target(6, "turbine KX-07", on_site=True)
    assert titles(
        Intent("BoatLandingClearanceSweep", landing), Intent("FeatureStare", landing)
    ) == ["BoatLandingClearanceSweep", "FeatureStare"]


def test_one_request_for_several_targets_is_carried_out_at_each():
    assert plan(Intent("PerformOrbit", MAST, {"radius": 12}, also=(BARGE,))) == [
        ("Transit", {"target_position": [120, -35]}),
        ("PerformOrbit", {"center": [120, -35], "radius": 12}),
        ("SearchAndDetect", {"target_description": "barge Elsa"}),
        ("Transit", {"target_position": UNRESOLVED}),
        ("PerformOrbit", {"center": UNRESOLVED, "radius": 12}),
    ]


def test_what_is_taken_back_is_not_planned():
    assert titles(Intent("SurveyTarget", MAST, instead=Intent("PerformOrbit", MAST))) == [
        "SurveyTarget"
    ]
