"""How operators ask for pictures: panoramas, steady footage, glare-free imagery, thermal readings
and hot spots.
"""

from __future__ import annotations

from planner_ft.data.mission.synthetic.bank_adjuncts import DURATION
from planner_ft.data.mission.synthetic.phrases import TaskPhrases, listed

HORIZONTAL_PANORAMA = TaskPhrases(
    imperatives=listed("""
        take a panorama at {target}; shoot a panorama from {target}; take a panorama from {target}; make a panorama at {target}
        shoot an all-round panorama at {target}; take pictures all round from {target}; photograph the whole horizon from {target}
        capture a 360 panorama at {target}; get all-round imagery at {target}; do a panoramic sweep at {target}; record a panorama at {target}
        give me the view all round from {target}; image every direction from {target}; take an all-round picture from {target}
        take a round of photos on the spot at {target}; shoot the horizon all the way round at {target}; grab a panorama at {target}
        snap pictures in every direction from {target}; turn on the spot at {target} and photograph everything round you
        spin on the spot at {target} taking pictures; pan right round with the camera at {target}; do a horizontal panorama at {target}
        collect panoramic imagery at {target}; build a panorama from {target}; stitch together a panorama at {target}; do a pano at {target}
        get me a pano from {target}; take in the whole skyline from {target}; capture the surroundings all round from {target}
        photograph all the sectors from {target}; look all round with the camera at {target}; acquire a panorama at {target}
        shoot a wide panorama beside {target}; take a panoramic photo set at {target}; do a photo round of the horizon from {target}
        take stills round the compass from {target}; do a full horizon panorama at {target}; picture everything around you at {target}
        get an all-round view at {target}; produce a panorama at {target}
    """),
    noun_phrases=listed("""
        a panorama at {target}; an all-round panorama from {target}; a horizontal panorama at {target}; a 360 panorama at {target}
        all-round imagery from {target}; a panoramic sweep at {target}; a photo panorama from {target}; a pano at {target}
        pictures all round from {target}; a view of the whole horizon from {target}; a set of pictures in every direction from {target}
        panoramic imagery at {target}; a panoramic shot beside {target}; a picture of the whole skyline from {target}; an all-round view from {target}
    """),
    gerunds=listed("""
        taking a panorama at {target}; shooting a panorama from {target}; photographing the horizon from {target}; taking pictures all round at {target}
        doing a panorama at {target}; making the panorama at {target}; capturing an all-round view at {target}; doing a panoramic sweep at {target}
        getting all-round imagery from {target}; recording the panorama at {target}; shooting the pano at {target}
    """),
    adjuncts={
        "sectors": listed("""
            in {sectors} sectors; with {sectors} sectors; {sectors} sectors; over {sectors} sectors; split into {sectors} sectors; using {sectors} headings
            on {sectors} headings; {sectors} headings in all; stopping on {sectors} headings; in {sectors} steps; divided into {sectors} sectors
            a picture on each of {sectors} headings; with {sectors} shooting directions
        """),
        "overlap": listed("""
            with {overlap} overlap; overlapping by {overlap}; at {overlap} overlap; {overlap} overlap; with an overlap of {overlap}
            frames overlapping {overlap}; neighbouring shots overlapping by {overlap}; overlap {overlap}; keep the overlap at {overlap}
            images to overlap by {overlap}; with {overlap} of overlap between frames
        """),
        "wait": listed("""
            waiting {wait} at each; with {wait} at each heading; pausing {wait} at each; {wait} wait at each; with a {wait_compound} wait at each
            wait {wait} on each heading; resting {wait} per sector; {wait} pause between frames; dwelling {wait} on every heading
            with a pause of {wait} at each stop; holding {wait} on each heading; {wait} per heading
        """),
    },
    here_imperatives=listed("""
        take a panorama from where you are; shoot an all-round panorama right here; do a pano on the spot; photograph the horizon from where you are
        get a panorama from your present position; take pictures all round from here; do a panoramic sweep from where you lie
        grab a panorama without moving off
    """),
    bare_imperatives=listed("""
        take a panorama; shoot a panorama; do a pano; take an all-round panorama; photograph the whole horizon; take pictures all round
        make a 360 panorama; get all-round imagery; do a panoramic sweep; capture a panorama; shoot the view all round; record a panorama
        get me the full horizon in pictures; photograph every direction; do a horizontal panorama
    """),
    bare_noun_phrases=listed("""
        a panorama; an all-round panorama; a 360 panorama; a horizontal panorama; all-round imagery; a panoramic sweep; a pano
        pictures all round; a view of the whole horizon
    """),
    bare_gerunds=listed("""
        taking a panorama; shooting a panorama; photographing the whole horizon; taking pictures all round; doing a panoramic sweep; doing a pano
        getting all-round imagery; shooting the view all round
    """),
    valued_imperatives=listed("""
        shoot {sectors} sectors all round from {target}; do a panorama of {sectors} sectors at {target}; take {sectors} pictures round the horizon at {target}
        shoot {sectors} sectors of panorama; do a panorama of {sectors} sectors; take a {sectors}-sector panorama at {target}
        do a {sectors}-sector panorama
    """),
    valued_noun_phrases=listed("""
        a {sectors}-sector panorama at {target}; a panorama of {sectors} sectors from {target}; a {sectors}-sector panorama; a panorama of {sectors} sectors
    """),
)

FEATURE_STARE = TaskPhrases(
    imperatives=listed("""
        film {feature_type} of {target}; film {feature_type} on {target}; film {feature_type} at {target}; video {feature_type} at {target}
        take steady footage of {feature_type} at {target}; record steady video of {feature_type} on {target}; stare at {feature_type} of {target}
        lock onto {feature_type} of {target} and film; keep the camera on {feature_type} of {target}; hold the camera on {feature_type} at {target}
        get steady video of {feature_type} at {target}; shoot a steady clip of {feature_type} on {target}; record {feature_type} of {target} on video
        stop beside {target} and film {feature_type}; stop at {target} and record {feature_type} on video; train the camera on {feature_type} of {target}
        keep {feature_type} of {target} in the picture and record; give me steady footage of {feature_type} at {target}
        take a steady video of {feature_type} of {target}; fix the camera on {feature_type} at {target}; get unshaken footage of {feature_type} on {target}
        roll video on {feature_type} at {target}; point the camera at {feature_type} on {target} and keep it rolling
        lock the camera on {feature_type} of {target}; shoot video of {feature_type} at {target}; get a stable video of {feature_type} on {target}
        capture steady footage of {feature_type} on {target}; run the video on {feature_type} of {target}; film {feature_type} of {target} steadily
        hold still in front of {target} and film {feature_type}; keep filming {feature_type} at {target}; stay on {feature_type} of {target} with the video
        zero in on {feature_type} of {target} and record it; do a feature stare on {feature_type} of {target}; tape {feature_type} of {target}
        get a long steady shot of {feature_type} at {target}; keep your lens on {feature_type} of {target}
    """),
    noun_phrases=listed("""
        steady footage of {feature_type} at {target}; steady video of {feature_type} of {target}; a steady shot of {feature_type} on {target}
        a video of {feature_type} on {target}; stable footage of {feature_type} on {target}; a film of {feature_type} of {target}
        a steady clip of {feature_type} at {target}; a locked-on video of {feature_type} of {target}; a camera stare at {feature_type} of {target}
        a steady recording of {feature_type} at {target}; some video of {feature_type} at {target}; a fixed shot of {feature_type} on {target}
        continuous video of {feature_type} on {target}
    """),
    gerunds=listed("""
        filming {feature_type} of {target}; filming {feature_type} at {target}; recording {feature_type} on {target}
        taking steady footage of {feature_type} at {target}; keeping the camera on {feature_type} of {target}; shooting video of {feature_type} on {target}
        staring at {feature_type} of {target}; getting steady video of {feature_type} at {target}; locking the camera on {feature_type} of {target}
        holding the camera on {feature_type} at {target}
    """),
    adjuncts={"duration": DURATION},
    here_imperatives=listed("""
        film {feature_type} from where you are; keep the camera on {feature_type} without moving off; record {feature_type} from your present spot
        get steady video of {feature_type} from right here
    """),
    bare_imperatives=listed("""
        film {feature_type}; film {feature_type} steadily; take steady footage of {feature_type}; record steady video of {feature_type}
        keep the camera on {feature_type}; lock onto {feature_type} and record; stare at {feature_type}; get steady video of {feature_type}
        video {feature_type}; shoot a steady clip of {feature_type}; hold the camera on {feature_type}; train the camera on {feature_type} and film
        stop and film {feature_type}; give me steady video of {feature_type}; hold {feature_type} in the frame and record; tape {feature_type}
    """),
    bare_noun_phrases=listed("""
        steady footage of {feature_type}; steady video of {feature_type}; a steady shot of {feature_type}; a video of {feature_type}
        a camera stare at {feature_type}; a film of {feature_type}; a steady clip of {feature_type}
    """),
    bare_gerunds=listed("""
        filming {feature_type}; taking steady footage of {feature_type}; keeping the camera on {feature_type}; recording steady video of {feature_type}
        staring at {feature_type}; getting steady video of {feature_type}; holding the camera on {feature_type}; shooting video of {feature_type}
    """),
    valued_imperatives=listed("""
        get {duration} of steady video of {feature_type} at {target}; film {duration} of {feature_type} on {target}
        give me {duration} of steady footage of {feature_type} of {target}; record {duration} of video of {feature_type} at {target}
        take {duration} of steady video of {feature_type}; give us {duration} of film of {feature_type}; shoot {duration} of {feature_type}
    """),
    valued_noun_phrases=listed("""
        {duration} of steady footage of {feature_type} at {target}; {duration} of video of {feature_type} on {target}
        a {duration_compound} video of {feature_type} of {target}; {duration} of steady video of {feature_type}; a {duration_compound} clip of {feature_type}
    """),
)

GLARE_FREE_APPROACH = TaskPhrases(
    imperatives=listed("""
        photograph {target_feature} of {target} without glare; get {target_feature} on {target} without reflections
        take glare-free pictures of {target_feature} at {target}; shoot {target_feature} of {target} free of glare
        get a glare-free shot of {target_feature} on {target}; approach {target} so that nothing reflects off {target_feature}
        find an angle on {target_feature} of {target} with no glare; capture {target_feature} at {target} with no reflections
        go round the glare and picture {target_feature} of {target}; get {target_feature} at {target} with the sun out of the lens
        image {target_feature} of {target} from where it does not glare; reposition at {target} until {target_feature} shows without glare
        get a picture of {target_feature} at {target} clear of glare; take reflection-free stills of {target_feature} on {target}
        snap {target_feature} of {target} without any sun glare; move about {target} for a glare-free view of {target_feature}
        photograph {target_feature} at {target} with no sun on the lens; make sure there is no glare when you picture {target_feature} of {target}
        do a glare-free approach on {target_feature} of {target}; get an unglared image of {target_feature} at {target}
        shift about at {target} until the reflections on {target_feature} are gone; take {target_feature} of {target} from a side without reflections
        record {target_feature} of {target} without reflections; dodge the sun and photograph {target_feature} on {target}
        come at {target} out of the glare and shoot {target_feature}; get {target_feature} of {target} readable, no glare
        avoid the reflections and get a picture of {target_feature} at {target}; keep the sun glint off {target_feature} of {target} in your pictures
        get clean pictures of {target_feature} at {target}, nothing mirrored; work round the sun glint and image {target_feature} of {target}
        shoot {target_feature} on {target} with the glare kept out; capture {target_feature} of {target} free from reflections
        film {target_feature} of {target} without glare; take pictures of {target_feature} on {target} that are not washed out by glare
    """),
    noun_phrases=listed("""
        glare-free pictures of {target_feature} at {target}; a glare-free shot of {target_feature} on {target}
        reflection-free imagery of {target_feature} of {target}; a picture of {target_feature} on {target} without glare
        glare-free imagery of {target_feature} at {target}; a shot of {target_feature} of {target} with no reflections
        an image of {target_feature} of {target} free of glare; glare-free stills of {target_feature} of {target}
        a view of {target_feature} at {target} without sun glint; a glare-free approach to {target_feature} of {target}
        reflection-free photos of {target_feature} on {target}; an unglared picture of {target_feature} of {target}
    """),
    gerunds=listed("""
        photographing {target_feature} of {target} without glare; getting {target_feature} on {target} free of reflections
        taking glare-free pictures of {target_feature} at {target}; shooting {target_feature} of {target} clear of the glare
        finding a glare-free view of {target_feature} at {target}; capturing {target_feature} of {target} without reflections
        doing the glare-free approach on {target_feature} of {target}; getting a glare-free shot of {target_feature} at {target}
        imaging {target_feature} at {target} without sun glare
    """),
    here_imperatives=listed("""
        photograph {target_feature} without glare from about where you are; get {target_feature} free of reflections right there
    """),
    bare_imperatives=listed("""
        photograph {target_feature} without glare; get {target_feature} without reflections; take glare-free pictures of {target_feature}
        get a glare-free shot of {target_feature}; shoot {target_feature} free of glare; capture {target_feature} with no reflections
        find a glare-free angle on {target_feature}; take reflection-free stills of {target_feature}; image {target_feature} without any glare
        get {target_feature} with no sun on it; move round until {target_feature} shows without glare; snap {target_feature} with nothing reflecting
    """),
    bare_noun_phrases=listed("""
        glare-free pictures of {target_feature}; a glare-free shot of {target_feature}; reflection-free imagery of {target_feature}
        a picture of {target_feature} without glare; an image of {target_feature} with no reflections; glare-free stills of {target_feature}
    """),
    bare_gerunds=listed("""
        photographing {target_feature} without glare; getting {target_feature} without reflections; taking glare-free pictures of {target_feature}
        getting a glare-free shot of {target_feature}; shooting {target_feature} free of glare; capturing {target_feature} with no reflections
    """),
)

BANK_IMAGING = {
    "HorizontalPanorama": HORIZONTAL_PANORAMA,
    "FeatureStare": FEATURE_STARE,
    "GlareFreeApproach": GLARE_FREE_APPROACH,
}
