# SPDX-License-Identifier: GPL-3.0-or-later
#
# Finds the installed YADE by what its own launcher says:
#
#   YADE_EXECUTABLE   the launcher (cache variable; Debian's own first)
#   YADE_PYTHON       the interpreter in the launcher's first line
#   YADE_LIBRARY_DIR  the folder with libyade.so (cache variable, if the launcher does not tell)
#   YADE_VERSION      as YADE names it: 2023.02a
#   YADE_VERSION_NUMBER  the same as a number, 202302, or 0: what abi/builds.hpp compares
find_program(YADE_EXECUTABLE yade PATHS /usr/bin NO_DEFAULT_PATH DOC "YADE's launcher")
find_program(YADE_EXECUTABLE yade)

unset(YADE_PYTHON)
unset(YADE_VERSION)
set(yade_found_dir YADE_LIBRARY_DIR-NOTFOUND)
if(YADE_EXECUTABLE)
    # A YADE that is exchanged for another is looked at again.
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${YADE_EXECUTABLE})
    file(STRINGS ${YADE_EXECUTABLE} yade_shebang LIMIT_COUNT 1)
    if(yade_shebang MATCHES "^#! *[^ ]*/env +([^ ]+)")
        find_program(YADE_PYTHON_BY_NAME ${CMAKE_MATCH_1})
        set(YADE_PYTHON ${YADE_PYTHON_BY_NAME})
    elseif(yade_shebang MATCHES "^#! *([^ ]*python[^ ]*)")
        set(YADE_PYTHON ${CMAKE_MATCH_1})
    endif()
    # The launcher enters the folder of YADE's Python package, which lies in that of the libraries.
    file(STRINGS ${YADE_EXECUTABLE} yade_lines REGEX "sys\\.path\\.insert")
    if(yade_lines MATCHES "['\"]([^'\"]*)/py['\"]")
        set(yade_found_dir ${CMAKE_MATCH_1})
    endif()
endif()
set(YADE_LIBRARY_DIR "" CACHE PATH "Folder of YADE's libraries, if its launcher does not tell")
if(NOT YADE_LIBRARY_DIR)
    set(YADE_LIBRARY_DIR ${yade_found_dir})
endif()

if(EXISTS ${YADE_LIBRARY_DIR}/py/yade/config.py)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${YADE_LIBRARY_DIR}/py/yade/config.py)
    file(STRINGS ${YADE_LIBRARY_DIR}/py/yade/config.py yade_lines REGEX "^version *=")
    if(yade_lines MATCHES "['\"]([^'\"]+)['\"]")
        set(YADE_VERSION ${CMAKE_MATCH_1})
    endif()
endif()
set(YADE_FOUND TRUE)
set(YADE_VERSION_NUMBER 0)
if(YADE_VERSION MATCHES "^([0-9][0-9][0-9][0-9])\\.0*([0-9]+)")
    math(EXPR YADE_VERSION_NUMBER "${CMAKE_MATCH_1} * 100 + ${CMAKE_MATCH_2}")
endif()

if(NOT EXISTS "${YADE_PYTHON}" OR NOT EXISTS ${YADE_LIBRARY_DIR}/libyade.so OR NOT YADE_VERSION)
    message(FATAL_ERROR "YADE was not found, or not understood: launcher '${YADE_EXECUTABLE}', its interpreter '${YADE_PYTHON}', "
        "its libraries '${YADE_LIBRARY_DIR}', its version '${YADE_VERSION}'. Install the Debian packages yade, libyade and "
        "python3-yade (make setup), or set YADE_EXECUTABLE and YADE_LIBRARY_DIR.")
endif()
