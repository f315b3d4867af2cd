# Port of vcpkg: libpong, its headers, and the CMake package pong (docs/packaging.md). It has not been submitted, and PONG_SOURCE_ARCHIVE
# stands for what vcpkg_download_distfile will return when the source tarball has an address.
if(NOT DEFINED PONG_SOURCE_ARCHIVE AND DEFINED ENV{PONG_SOURCE_ARCHIVE})
    set(PONG_SOURCE_ARCHIVE "$ENV{PONG_SOURCE_ARCHIVE}")
endif()
if(NOT EXISTS "${PONG_SOURCE_ARCHIVE}")
    message(FATAL_ERROR "PONG_SOURCE_ARCHIVE names no source tarball of pong: make one by packaging/source, and set the variable.")
endif()
find_program(CARGO cargo)
if(NOT CARGO)
    message(FATAL_ERROR "cargo is missing, and pong is written in Rust: install the version that rust-toolchain.toml names.")
endif()
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${PONG_SOURCE_ARCHIVE}")

# Everything is compiled in one way: a debug library of Rust is of no use to a host. The shared library is linked by ci/install.
set(ENV{CARGO_TARGET_DIR} "${CURRENT_BUILDTREES_DIR}/${TARGET_TRIPLET}-rel")
vcpkg_execute_required_process(
    COMMAND "${CARGO}" build --release --offline --locked -p pong-capi -p pong-cli -p pong-fmu
    WORKING_DIRECTORY "${SOURCE_PATH}"
    LOGNAME "build-${TARGET_TRIPLET}-rel")
vcpkg_execute_required_process(
    COMMAND "${CMAKE_COMMAND}" -E env "BUILD_DIR=$ENV{CARGO_TARGET_DIR}/release" DEBUG_SYMBOLS=0 UNINSTALLER=0 RELOCATABLE=1
        BINDIR=tools/pong CMAKEDIR=share/pong DOCDIR=share/pong/doc bash ci/install "${CURRENT_PACKAGES_DIR}"
    WORKING_DIRECTORY "${SOURCE_PATH}"
    LOGNAME "install-${TARGET_TRIPLET}-rel")
set(VCPKG_BUILD_TYPE release)
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE" "${SOURCE_PATH}/THIRD_PARTY_LICENSES.md")
