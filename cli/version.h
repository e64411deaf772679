/* What this program is: version, compiler, host back end; the first three are set by the build. */
#ifndef CLI_VERSION_H
#define CLI_VERSION_H

#ifdef __clang__
#define VERSION_COMPILER "clang " __clang_version__
#else
#define VERSION_COMPILER "gcc " __VERSION__
#endif

#define VERSION_NUMBER LANETRACE_VERSION
#define VERSION_BACKEND LANETRACE_BACKEND
#define VERSION_LINE "lanetrace " VERSION_NUMBER " (" VERSION_COMPILER ", host back end " VERSION_BACKEND ")"

#endif
