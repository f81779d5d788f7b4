# make demo   a new vehicle from data to plan: adapter, benchmark, one table, one figure, three sentences (build/demo)
# make demo-readme   the same, and its table goes into README.md
# make test   lint, types, tests and the CI gate
# make peers-test   our benchmark inside lm-evaluation-harness, and TRL on our data, in an environment of its own
#
# VENV=DIR          use (or make) another virtual environment
# CONSTRAINTS=FILE  other pinned versions; CONSTRAINTS=/dev/null keeps what is installed (a CUDA build of torch, say)

PYTHON ?= python3
VENV ?= .venv
CONSTRAINTS ?= constraints.txt
BIN := $(VENV)/bin
INSTALLED := $(VENV)/.planner_ft-installed
export HF_HUB_OFFLINE ?= 1
export TOKENIZERS_PARALLELISM ?= false

.PHONY: demo demo-readme test install lint types gate peers-test server-test calibrate clean

install: $(INSTALLED)

$(INSTALLED): pyproject.toml $(wildcard $(CONSTRAINTS))
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@# torch first and by its pin: an open range would take the newest build, whatever its size.
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c $(CONSTRAINTS) torch
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c $(CONSTRAINTS) -e ".[dev]"
	$(BIN)/python -m compileall -q planner_ft
	touch $@

# The drone is a vehicle that the embedded base was not made for; its adapter is trained here. The surface vehicle's planner ships.
DRONE := --level mission --vocabulary inspection_drone
demo: install
	$(BIN)/plannerft gen-data --level mission --out build/demo/data/usv --overwrite
	$(BIN)/plannerft gen-data $(DRONE) --out build/demo/data/drone --overwrite
	$(BIN)/plannerft train $(DRONE) --candidate embedded --data-dir build/demo/data/drone/mission --output build/demo/adapter --overwrite
	$(BIN)/plannerft bench $(DRONE) --candidates embedded --configurations base,base+schema,lora,lora+schema,lora+grounded --adapter build/demo/adapter \
	    --data data/inspection_drone/mission/challenge.jsonl --max-new-tokens 800 --latency-samples 0 --no-report --out build/demo/drone --overwrite
	$(BIN)/plannerft bench --level mission --candidates embedded --configurations lora+grounded \
	    --data data/mission/challenge.jsonl --limit 40 --latency-samples 0 --no-report --out build/demo/surface --overwrite
	$(BIN)/plannerft plan "Circle the chimney at [40, 25] at eight metres and come home." \
	    --vocabulary inspection_drone --mission-adapter build/demo/adapter --mission-only
	$(BIN)/plannerft plan "Find the rusty mooring buoy, film its shackle for two minutes, then come home." --locate "mooring buoy=120,-35"
	$(BIN)/python scripts/demo.py build/demo

# The same, and the table and sentences go into README.md, between its two marks.
demo-readme: demo
	$(BIN)/python scripts/demo.py build/demo --into README.md

test: lint types
	$(BIN)/python -m pytest -n 2 --dist worksteal
	$(BIN)/plannerft bench --gate eval/gates/ci.toml

lint: install
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: install
	$(BIN)/mypy

# lm-evaluation-harness and TRL change what the package is tested with: they have an environment of their own.
PEERS_VENV ?= .venv-peers
peers-test:
	test -x $(PEERS_VENV)/bin/python || $(PYTHON) -m venv $(PEERS_VENV)
	$(PEERS_VENV)/bin/python -m pip install --quiet --disable-pip-version-check -c $(CONSTRAINTS) torch
	$(PEERS_VENV)/bin/python -m pip install --quiet --disable-pip-version-check -c $(CONSTRAINTS) -c benchmarks/peers.txt -e ".[dev,peers]"
	$(PEERS_VENV)/bin/python -m pytest -m peers tests/lm_eval tests/training/test_train_trl.py

# llama.cpp builds from source for minutes (CMAKE_BUILD_PARALLEL_LEVEL=1 on a small machine): it has an environment of its own, too.
SERVER_VENV ?= .venv-server
server-test: install
	test -x $(SERVER_VENV)/bin/python || $(PYTHON) -m venv $(SERVER_VENV)
	CMAKE_ARGS="-DLLAVA_BUILD=OFF $(CMAKE_ARGS)" $(SERVER_VENV)/bin/python -m pip install --quiet --disable-pip-version-check -c benchmarks/server.txt "llama-cpp-python[server]"
	PLANNERFT_SERVER_PYTHON=$(SERVER_VENV)/bin/python $(BIN)/python -m pytest -m server tests/model_export/test_server.py

# How sure the embedded candidate's agents are, on the development sets; never on test data (task_unseen, data/mission/challenge).
calibrate: install
	$(BIN)/plannerft calibrate --overwrite --level mission eval/challenge/mission*.jsonl
	$(BIN)/plannerft calibrate --overwrite --level task $(filter-out %unseen.jsonl,$(wildcard eval/challenge/task*.jsonl))

clean:
	rm -rf build $(VENV)
