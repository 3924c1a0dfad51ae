# The target `api` writes pages of the installed headers into build/release/api/html, by Doxygen where it is there;
# its warnings are errors.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  return()
endif()
set(DOXYGEN_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/api")
set(DOXYGEN_PROJECT_NAME orthonav)
set(DOXYGEN_FULL_PATH_NAMES YES)
set(DOXYGEN_STRIP_FROM_PATH "${PROJECT_SOURCE_DIR}")
set(DOXYGEN_STRIP_FROM_INC_PATH "${PROJECT_SOURCE_DIR}")
# The first sentence is the summary; entities without a comment are allowed.
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_EXTRACT_ALL YES)
set(DOXYGEN_BUILTIN_STL_SUPPORT YES)
set(DOXYGEN_AUTOLINK_SUPPORT YES)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
set(DOXYGEN_QUIET YES)
# Annotations for thread-safety analysis are left out of the pages.
set(DOXYGEN_MACRO_EXPANSION YES)
set(DOXYGEN_EXPAND_ONLY_PREDEF YES)
set(DOXYGEN_PREDEFINED "ORTHONAV_CAPABILITY(x)=" ORTHONAV_SCOPED_CAPABILITY=)
foreach(annotation GUARDED_BY ACQUIRE RELEASE REQUIRES EXCLUDES)
  list(APPEND DOXYGEN_PREDEFINED "ORTHONAV_${annotation}(x)=")
endforeach()
# Plain pages, identical in every build: no pictures, no third-party scripts, no date.
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_CLASS_DIAGRAMS NO)
set(DOXYGEN_SEARCHENGINE NO)
set(DOXYGEN_HTML_DYNAMIC_MENUS NO)
set(DOXYGEN_HTML_TIMESTAMP NO)
set(DOXYGEN_VERBATIM_HEADERS NO)
get_property(orthonav_headers GLOBAL PROPERTY ORTHONAV_HEADERS)
doxygen_add_docs(api ALL ${orthonav_headers} WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}" USE_STAMP_FILE
                 COMMENT "Writing the pages of the headers")
if(ORTHONAV_BUILD_TESTS)
  add_test(NAME api.PagesAreWrittenWithoutWarnings
           COMMAND "${CMAKE_COMMAND}" --build "${PROJECT_BINARY_DIR}" --target api)
endif()
install(DIRECTORY "${PROJECT_BINARY_DIR}/api/html/" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/orthonav-doc/api"
        COMPONENT doc OPTIONAL)
