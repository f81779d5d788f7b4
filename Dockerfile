# planner_ft on an NVIDIA GPU. Not built by us; a test checks its form and the files that it names.
#   docker build -t planner_ft .
#   docker run --gpus all -it -e HF_TOKEN -v hub:/models -v "$PWD":/work planner_ft
#   (inside) plannerft doctor && hf download meta-llama/Llama-3.2-3B-Instruct --exclude "original/*"
ARG CUDA=12.8.1
FROM nvidia/cuda:${CUDA}-base-ubuntu24.04
RUN apt-get update \
    && apt-get install -y --no-install-recommends python3 python3-venv git \
    && rm -rf /var/lib/apt/lists/*
ENV PATH=/opt/venv/bin:$PATH HF_HOME=/models
# torch from PyPI brings its own CUDA libraries; this layer stays while the source changes.
COPY constraints.txt /src/
RUN python3 -m venv /opt/venv \
    && pip install --no-cache-dir -c /src/constraints.txt torch
COPY pyproject.toml README.md LICENSE /src/
COPY planner_ft /src/planner_ft
COPY adapters /src/adapters
COPY data /src/data
RUN pip install --no-cache-dir -c /src/constraints.txt /src
WORKDIR /work
CMD ["bash"]
