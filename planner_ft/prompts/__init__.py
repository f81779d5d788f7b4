"""The one place that turns a sample into token ids, for training, benchmark and planning alike."""

from planner_ft.prompts.render import (
    Rendered,
    end_of_turn_ids,
    ends_of_answers,
    render_prompt,
    render_sample,
)

__all__ = ["Rendered", "end_of_turn_ids", "ends_of_answers", "render_prompt", "render_sample"]
