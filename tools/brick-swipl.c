/*  brick-prolog's bin/swipl: starts the SWI-Prolog beside it with the dynamic
    loader and the libraries that came with it, wherever the folder was put.

    It is a program, not a script. SWI-Prolog takes the file it was started as
    for its Prolog flag `executable`, which other programs and saved states
    start again; of a script it takes the interpreter, /bin/sh.

    The libraries are named on the loader's command line, not in
    LD_LIBRARY_PATH, so that programs which Prolog starts get the system's. The
    C library finds its one locale by two variables; swipl.rc sets them back.
*/

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char self[PATH_MAX];
static char folder[PATH_MAX];

static void fail(const char *text)
{
    static const char name[] = "brick-prolog: ";

    (void)!write(2, name, sizeof name - 1);
    (void)!write(2, text, strlen(text));
    (void)!write(2, "\n", 1);
    _exit(127);
}

/* The absolute name of a file in brick-prolog's folder. */
static char *file(const char *name)
{
    char *path = malloc(strlen(folder) + 1 + strlen(name) + 1);

    if (!path)
        fail("no memory");
    strcpy(path, folder);
    strcat(path, "/");
    return strcat(path, name);
}

/* Sets a variable; what it was is kept in SAVED. */
static void replace(const char *name, const char *saved, const char *value)
{
    const char *old = getenv(name);

    if (old)
        setenv(saved, old, 1);
    else
        unsetenv(saved);
    setenv(name, value, 1);
}

int main(int argc, char **argv)
{
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    char *slash;
    char **args = calloc(argc + 7, sizeof *args);
    int count = 0, i;

    if (length < 0)
        fail("cannot read /proc/self/exe");
    if (!args)
        fail("no memory");

    /* <folder>/bin/swipl */
    strcpy(folder, self);
    for (i = 0; i < 2; i++)
        if ((slash = strrchr(folder, '/')))
            *slash = '\0';
    if (strpbrk(folder, ":;"))
        fail("the name of its folder must not contain : or ;");

    replace("LOCPATH", "BRICK_PROLOG_LOCPATH", file("lib/locale"));
    replace("LC_ALL", "BRICK_PROLOG_LC_ALL", "C.UTF-8");
    /* That of the system's SWI-Prolog; ours is found by swipl.home. */
    unsetenv("SWI_HOME_DIR");

    args[count++] = "swipl";
    args[count++] = "--library-path";
    args[count++] = file("lib");
    args[count++] = "--argv0";
    args[count++] = self;
    args[count++] = file("libexec/prolog");
    for (i = 1; i < argc; i++)
        args[count++] = argv[i];
    execv(file("libexec/swipl"), args);
    fail("cannot start libexec/swipl: was all of the archive unpacked?");
}
