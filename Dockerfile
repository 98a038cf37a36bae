ARG BASE_IMAGE=docker.io/library/python:3.12-slim-bookworm
FROM ${BASE_IMAGE} AS build
ENV UV_SYSTEM_CERTS=1 NODE_OPTIONS=--use-system-ca
WORKDIR /src
COPY requirements.lock pyproject.toml README.md LICENSE ./
RUN python3 -m venv /opt/svsa \
 && /opt/svsa/bin/pip install --quiet --no-cache-dir --disable-pip-version-check uv
COPY svsa svsa
COPY backend backend
COPY frontend frontend
RUN /opt/svsa/bin/uv build --wheel --out-dir /dist --python /opt/svsa/bin/python . \
 && /opt/svsa/bin/uv pip install --quiet --compile-bytecode --python /opt/svsa/bin/python --constraint requirements.lock "$(ls /dist/*.whl)[server,bench,plot,nidaqmx]" \
 && /opt/svsa/bin/pip uninstall --quiet --yes uv

FROM ${BASE_IMAGE}
RUN useradd --create-home --uid 1000 svsa && install -d -o svsa -g svsa /data
COPY --from=build /opt/svsa /opt/svsa
ENV PATH=/opt/svsa/bin:$PATH PYTHONUNBUFFERED=1 SVSA_DATA=/data
VOLUME /data
USER svsa
WORKDIR /home/svsa
RUN svsa compile
EXPOSE 8000
CMD ["svsa", "serve", "--host", "auto", "--port", "8000"]
