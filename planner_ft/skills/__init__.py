"""How learnt skills are made: batched dynamics, training, policies, and the table beside baselines.

`tracking` learns GoToXY and StationKeep through the dynamics, `imitation` and `ppo` learn
SurveyTarget in `survey`; `mission` runs what was learnt as skills of a plan.
"""
