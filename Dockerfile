# voussoir in a container of Debian 12: the first stage builds the package, the second has the package alone.
#   docker build -t voussoir .
#   docker run --rm -v "$PWD:/work" -u "$(id -u):$(id -g)" voussoir run /usr/share/voussoir/cases/demo.toml -o demo
FROM debian:12-slim AS build
RUN apt-get update && apt-get install -y --no-install-recommends git dpkg-dev file && rm -rf /var/lib/apt/lists/*
WORKDIR /voussoir
COPY tools/install-packages tools/
RUN tools/install-packages
COPY . .
RUN git config --global --add safe.directory /voussoir \
 && cmake --preset package && cmake --build --preset package && (cd build/package && cpack -G DEB)

FROM debian:12-slim
RUN --mount=type=bind,from=build,source=/voussoir/build/package/packages,target=/packages \
    apt-get update && apt-get install -y --no-install-recommends /packages/voussoir_*.deb /packages/python3-voussoir_*.deb libopenblas0-pthread && rm -rf /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["voussoir"]
CMD ["--help"]
