# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
#
# Writes the header that holds the revision of the sources, empty where they are in no repository;
# leaves it alone where it says so already. Called at each build:
#   cmake -D SOURCES=DIR -D HEADER=FILE -P revision.cmake
execute_process(COMMAND git -C ${SOURCES} describe --always --exclude=* --abbrev=10 --dirty=\ and\ changes
                OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(text "#define GRAUPEL_REVISION \"${revision}\"\n")
if(EXISTS ${HEADER})
  file(READ ${HEADER} before)
endif()
if(NOT text STREQUAL "${before}")
  file(WRITE ${HEADER} "${text}")
endif()
