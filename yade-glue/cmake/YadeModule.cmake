# SPDX-License-Identifier: GPL-3.0-or-later
#
# How a module of C++ for the installed YADE is compiled, the plugin and those of users alike:
#
#   include(.../yade-glue/cmake/YadeModule.cmake)
#   pp_yade_module(my_law my_law.cpp)     makes my_law.so, which YADE's Python imports
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
get_filename_component(PP_GLUE ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)
set(PP_INCLUDE_DIR ${PP_GLUE}/../include CACHE PATH "Folder of potential_particles.h")

if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
endif()
# For every amd64 (no -march), and never -ffast-math: GCC 12 would then link code into the plugin
# that switches the whole process, YADE included, to flushing small numbers to zero.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -g1")
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)

find_package(YADE REQUIRED MODULE)
# The interpreter that runs YADE: another python3 on the path would give wrong headers.
set(Python3_EXECUTABLE ${YADE_PYTHON})
find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
# Debian names Boost's library for Python after the version of Python.
set(PP_BOOST_PYTHON python${Python3_VERSION_MAJOR}${Python3_VERSION_MINOR})
find_package(Boost REQUIRED CONFIG COMPONENTS ${PP_BOOST_PYTHON} serialization)
find_package(Eigen3 REQUIRED NO_MODULE)

# Every translation unit and the ABI probe must agree on these.
set(PP_DEFINITIONS
    PP_YADE_VERSION=${YADE_VERSION_NUMBER}
    EIGEN_DONT_ALIGN EIGEN_DONT_VECTORIZE
    BOOST_BIND_GLOBAL_PLACEHOLDERS BOOST_ALLOW_DEPRECATED_HEADERS)
set(PP_SYSTEM_INCLUDES
    ${Python3_INCLUDE_DIRS} ${Boost_INCLUDE_DIRS}
    $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>)

# abi/ and the folders of src by their names; plugin-common/ by its own. YADE's libraries are not linked: a running YADE
# has loaded them for everybody.
function(pp_yade_module name)
    add_library(${name} MODULE ${ARGN})
    set_target_properties(${name} PROPERTIES PREFIX "")
    target_compile_definitions(${name} PRIVATE ${PP_DEFINITIONS})
    target_compile_options(${name} PRIVATE -Wall -Wextra)
    target_include_directories(${name} PRIVATE ${PP_GLUE} ${PP_GLUE}/src ${PP_GLUE}/.. ${PP_INCLUDE_DIR})
    target_include_directories(${name} SYSTEM PRIVATE ${PP_SYSTEM_INCLUDES})
    target_link_libraries(${name} PRIVATE Boost::${PP_BOOST_PYTHON} Boost::serialization)
endfunction()
