# Works round export files of ParaView or VTK that give Python modules other names than the
# installed ones.
#
# The paraview-dev of Debian 13 and sid names vtkCommonCore.so where the file is called
# vtkCommonCore.cpython-313-x86_64-linux-gnu.so, and CMake refuses a package whose export files name
# missing files. But it passes over an export file whose targets all exist already. So the targets
# of an export file that is wrong in this way are made here, with the files that are installed. If
# export files are right, nothing is done; nothing is ever written to disk.

# isodiamonds_find_config(<package> <version> <variable>): the folder of the configuration that
# find_package(<package> <version>) will read, by its own rules; false if there is none.
function(isodiamonds_find_config package version variable)
  set(folder "${${package}_DIR}")
  if(NOT folder)
    find_package(${package} 999 CONFIG QUIET) # no such version: it looks, but reads nothing
    foreach(config considered IN ZIP_LISTS ${package}_CONSIDERED_CONFIGS ${package}_CONSIDERED_VERSIONS)
      if(NOT folder AND considered VERSION_GREATER_EQUAL version)
        get_filename_component(folder "${config}" DIRECTORY)
      endif()
    endforeach()
  endif()
  set(${variable} "${folder}" PARENT_SCOPE)
endfunction()

# isodiamonds_find_module(<prefix> <file> <variable>): the installed file of a Python module.
function(isodiamonds_find_module prefix file variable)
  string(REGEX REPLACE "\\.so$" ".cpython-*.so" pattern "${prefix}/${file}")
  file(GLOB files "${prefix}/${file}" "${pattern}")
  list(APPEND files "")
  list(GET files 0 file)
  set(${variable} "${file}" PARENT_SCOPE)
endfunction()

# isodiamonds_mend_export_file(<file>): makes the targets of an export file that is wrong.
function(isodiamonds_mend_export_file export_file)
  # The targets that CMake would check, and their modules; in a file for each build type.
  string(REGEX REPLACE "\\.cmake$" "-*.cmake" by_build_type "${export_file}")
  file(GLOB by_build_type "${by_build_type}")
  set(checks)
  foreach(file IN LISTS by_build_type)
    file(STRINGS "${file}" lines REGEX "_cmake_import_check_files_for_.*IMPORT_PREFIX}/.*\\.so\"")
    list(APPEND checks ${lines})
  endforeach()
  set(line_pattern ".*check_files_for_([^ ]+) \"[^/]*/([^\"]+)\".*")
  list(TRANSFORM checks REPLACE "${line_pattern}" "\\1" OUTPUT_VARIABLE targets)
  list(TRANSFORM checks REPLACE "${line_pattern}" "\\2" OUTPUT_VARIABLE modules)
  if(NOT modules)
    return()
  endif()

  # The prefix is the folder above the export file that contains the modules' folder.
  list(GET modules 0 module)
  get_filename_component(folder "${module}" DIRECTORY)
  get_filename_component(prefix "${export_file}" DIRECTORY)
  while(NOT EXISTS "${prefix}/${folder}" AND NOT prefix STREQUAL "/")
    get_filename_component(prefix "${prefix}" DIRECTORY)
  endwhile()
  if(EXISTS "${prefix}/${module}")
    return()
  endif()

  file(STRINGS "${export_file}" libraries REGEX "^add_library\\(.* IMPORTED\\)")
  foreach(library IN LISTS libraries)
    string(REGEX MATCH "\\(([^ ]+) ([A-Z]+) " library "${library}")
    if(NOT TARGET ${CMAKE_MATCH_1})
      add_library(${CMAKE_MATCH_1} ${CMAKE_MATCH_2} IMPORTED)
    endif()
  endforeach()
  foreach(target module IN ZIP_LISTS targets modules)
    isodiamonds_find_module("${prefix}" "${module}" file)
    set_target_properties(${target} PROPERTIES IMPORTED_LOCATION "${file}")
  endforeach()
endfunction()

# isodiamonds_mend_python_targets(<package> <version>): to be called before find_package(<package>
# <version>), and from the same folder.
function(isodiamonds_mend_python_targets package version)
  isodiamonds_find_config(${package} ${version} folder)
  if(folder)
    file(GLOB_RECURSE export_files "${folder}/*Python*-targets.cmake")
    foreach(export_file IN LISTS export_files)
      isodiamonds_mend_export_file("${export_file}")
    endforeach()
  endif()
endfunction()
