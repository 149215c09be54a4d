# Lays the package out in TO/potential_particles: the one of python/ with its built CORE, and of the folders MORE what is
# for a host; but for the host's _glue, what is no longer a file of them goes. Called by the builds of YADE's and LAMMPS's plugin.
file(GLOB OLD ${TO}/potential_particles/* ${TO}/potential_particles_lammps)
list(FILTER OLD EXCLUDE REGEX "/_glue[.]so$")
if(OLD)
    file(REMOVE_RECURSE ${OLD})
endif()
get_filename_component(ROOT ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)
foreach(FOLDER python ${MORE})
    file(COPY ${ROOT}/${FOLDER}/potential_particles DESTINATION ${TO} PATTERN __pycache__ EXCLUDE PATTERN _core*.so EXCLUDE)
endforeach()
file(COPY ${FILES} DESTINATION ${TO}/potential_particles)
configure_file(${CORE} ${TO}/potential_particles/_core.abi3.so COPYONLY)
