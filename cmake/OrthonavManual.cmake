# What the command tells of itself: manual pages and what bash completes. A cross build runs nothing and
# goes without.
find_program(GZIP_PROGRAM gzip)
if(CMAKE_CROSSCOMPILING OR NOT GZIP_PROGRAM)
  return()
endif()
set(manual "${PROJECT_BINARY_DIR}/manual")
add_custom_command(
  OUTPUT "${manual}/orthonav"
  COMMAND "${CMAKE_COMMAND}" -E rm -rf "${manual}"
  COMMAND orthonav manual --out "${manual}/man1"
  COMMAND sh -c "gzip -9n '${manual}'/man1/*.1 && '$<TARGET_FILE:orthonav>' completion bash > '${manual}/orthonav'"
  DEPENDS orthonav
  COMMENT "Writing the manual pages"
  VERBATIM)
add_custom_target(manual ALL DEPENDS "${manual}/orthonav")
# Where only the command was built there is no manual to install.
install(DIRECTORY "${manual}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}" COMPONENT runtime OPTIONAL)
install(FILES "${manual}/orthonav" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
        COMPONENT runtime OPTIONAL)
