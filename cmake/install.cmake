# Files that `cmake --install` and `cpack -G DEB` install (docs/machines.md). The installed program finds its data by
# paths relative to its own folder (harness/data_folder.hpp), so that the installation may be moved.
install(TARGETS pelage)
install(TARGETS pelage_image_module DESTINATION ${CMAKE_INSTALL_LIBDIR}/pelage)
install(DIRECTORY kernels shaders experiments examples readings DESTINATION ${CMAKE_INSTALL_DATADIR}/pelage
        USE_SOURCE_PERMISSIONS)  # experiments/slurm contains executable scripts
install(DIRECTORY harness/report/plots DESTINATION ${CMAKE_INSTALL_DATADIR}/pelage
        PATTERN __pycache__ EXCLUDE)
install(DIRECTORY harness/page/web/ DESTINATION ${CMAKE_INSTALL_DATADIR}/pelage/page)
install(FILES README.md ARTIFACT.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN pelage.1 EXCLUDE)
install(DIRECTORY python/pelage DESTINATION ${PELAGE_PYTHON_DIR} PATTERN __pycache__ EXCLUDE)
# The built program writes the commands of its manual page, so that they are exactly those of this build.
install(CODE "execute_process(COMMAND \"$<TARGET_FILE:pelage>\" manual \"${PROJECT_SOURCE_DIR}/docs/pelage.1\"
                OUTPUT_FILE \"${PROJECT_BINARY_DIR}/pelage.1\" COMMAND_ERROR_IS_FATAL ANY)")
install(FILES ${PROJECT_BINARY_DIR}/pelage.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The pelage maintainers")
set(CPACK_PACKAGE_DESCRIPTION "${PROJECT_DESCRIPTION}.
pelage times published systems for fur and grass (shells, wet fur, strands, mass-springs) on OpenCL devices, and checks
every timed picture against a reference in double precision. The Python package pelage reads the results as pandas data frames.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# dpkg-shlibdeps (Debian's package dpkg-dev) adds the packages of the linked libraries to the dependencies.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The packages below are recommended only, because pelage starts without them. They provide an OpenCL device, OpenGL for
# the OpenGL baseline, the plots of reports, a font for wetness.text, pandas for the Python package, and some models. If
# pelage needs one of these packages and does not find it, pelage prints a message.
string(JOIN ", " CPACK_DEBIAN_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd" libegl1 libegl-mesa0 libgl1-mesa-dri
       fonts-dejavu-core python3-matplotlib python3-pandas glmark2-data libcgal-demo)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS ffmpeg)  # pelage animate joins frames to videos with it
include(CPack)
