/* Makes system calls fail on demand: loaded before a program (LD_PRELOAD), it counts the calls that
 * concern files below one folder and lets the n-th of a kind fail. Told by the environment:
 *   FAIL_BELOW  the folder; what happens elsewhere is neither counted nor touched
 *   FAIL_CALL   open, write, sync, rename, close, mkdir, unlink or truncate
 *   FAIL_NTH    which one fails, from 1; 0: none
 *   FAIL_LAST   the last one that fails; without it only the n-th does
 *   FAIL_ERRNO  with this error, by number; 0: the program is killed in its place
 *   FAIL_COUNTS a file that gets "open 12" and so on, a line a kind, when the program ends
 * A write that fails has written half of its bytes before, as on a disk that fills up. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

enum Kind { kOpen, kWrite, kSync, kRename, kClose, kMkdir, kUnlink, kTruncate, kKinds };
static const char* const kNames[kKinds] = {"open",  "write", "sync",   "rename",
                                           "close", "mkdir", "unlink", "truncate"};

enum { kDescriptors = 4096 };
static atomic_int counts[kKinds];
static atomic_char watched[kDescriptors];

static long number(const char* name, long otherwise) {
    const char* text = getenv(name);
    return text != NULL ? atol(text) : otherwise;
}

static int isBelow(const char* path) {
    const char* folder = getenv("FAIL_BELOW");
    if (folder == NULL || path == NULL) return 0;
    const size_t length = strlen(folder);
    return strncmp(path, folder, length) == 0 && (path[length] == '/' || path[length] == 0);
}

/* The path of a name that counts from an open folder. */
static const char* pathFrom(int folder, const char* name, char* path) {
    if (folder == AT_FDCWD || name == NULL || name[0] == '/') return name;
    char link[64];
    snprintf(link, sizeof(link), "/proc/self/fd/%d", folder);
    const ssize_t length = readlink(link, path, PATH_MAX);
    if (length <= 0 || (size_t)length + strlen(name) + 2 > PATH_MAX) return name;
    path[length] = '/';
    strcpy(path + length + 1, name);
    return path;
}

static int isBelowFrom(int folder, const char* name) {
    char path[PATH_MAX];
    return isBelow(pathFrom(folder, name, path));
}

static int isWatched(int descriptor) {
    return descriptor >= 0 && descriptor < kDescriptors && watched[descriptor];
}

/* Counts a call; sets errno and says whether it is to fail. */
static int fails(enum Kind kind) {
    const int count = atomic_fetch_add(&counts[kind], 1) + 1;
    const char* wanted = getenv("FAIL_CALL");
    const long nth = number("FAIL_NTH", 0);
    if (wanted == NULL || nth <= 0 || strcmp(wanted, kNames[kind]) != 0) return 0;
    if (count < nth || count > number("FAIL_LAST", nth)) return 0;
    errno = (int)number("FAIL_ERRNO", EIO);
    if (errno == 0) raise(SIGKILL);
    return 1;
}

static void* next(const char* name) {
    return dlsym(RTLD_NEXT, name);
}

static int openWatched(const char* function, int folder, const char* path, int flags, mode_t mode) {
    const int below = isBelowFrom(folder, path);
    // O_PATH opens, the steps of a walk along a path, are not counted.
    if (below && (flags & O_PATH) == 0 && fails(kOpen)) return -1;
    int descriptor = -1;
    if (folder == AT_FDCWD) {
        int (*open_next)(const char*, int, ...) = (int (*)(const char*, int, ...))next(function);
        descriptor = open_next(path, flags, mode);
    } else {
        int (*open_next)(int, const char*, int, ...) =
            (int (*)(int, const char*, int, ...))next(function);
        descriptor = open_next(folder, path, flags, mode);
    }
    if (descriptor >= 0 && descriptor < kDescriptors) {
        watched[descriptor] = (char)(below && (flags & O_PATH) == 0);
    }
    return descriptor;
}

static mode_t modeOf(int flags, va_list list) {
    return (flags & (O_CREAT | O_TMPFILE)) != 0 ? (mode_t)va_arg(list, int) : 0;
}

int open(const char* path, int flags, ...) {
    va_list list;
    va_start(list, flags);
    const mode_t mode = modeOf(flags, list);
    va_end(list);
    return openWatched("open", AT_FDCWD, path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    va_list list;
    va_start(list, flags);
    const mode_t mode = modeOf(flags, list);
    va_end(list);
    return openWatched("open64", AT_FDCWD, path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
    va_list list;
    va_start(list, flags);
    const mode_t mode = modeOf(flags, list);
    va_end(list);
    return openWatched(folder == AT_FDCWD ? "open" : "openat", folder, path, flags, mode);
}

int openat64(int folder, const char* path, int flags, ...) {
    va_list list;
    va_start(list, flags);
    const mode_t mode = modeOf(flags, list);
    va_end(list);
    return openWatched(folder == AT_FDCWD ? "open64" : "openat64", folder, path, flags, mode);
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
    ssize_t (*write_next)(int, const void*, size_t) =
        (ssize_t(*)(int, const void*, size_t))next("write");
    if (isWatched(descriptor) && fails(kWrite)) {
        const int error = errno;
        if (write_next(descriptor, bytes, size / 2) < 0) return -1;
        errno = error;
        return -1;
    }
    return write_next(descriptor, bytes, size);
}

static int syncWatched(const char* function, int descriptor) {
    if (isWatched(descriptor) && fails(kSync)) return -1;
    return ((int (*)(int))next(function))(descriptor);
}

int fsync(int descriptor) {
    return syncWatched("fsync", descriptor);
}

int fdatasync(int descriptor) {
    return syncWatched("fdatasync", descriptor);
}

int syncfs(int descriptor) {
    return syncWatched("syncfs", descriptor);
}

int rename(const char* from, const char* to) {
    if (isBelow(to) && fails(kRename)) return -1;
    return ((int (*)(const char*, const char*))next("rename"))(from, to);
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
    if (isBelowFrom(to_folder, to) && fails(kRename)) return -1;
    return ((int (*)(int, const char*, int, const char*))next("renameat"))(from_folder, from,
                                                                           to_folder, to);
}

/* A close that fails has closed all the same. */
int close(int descriptor) {
    const int failing = isWatched(descriptor) && fails(kClose);
    const int error = errno;
    if (descriptor >= 0 && descriptor < kDescriptors) watched[descriptor] = 0;
    const int result = ((int (*)(int))next("close"))(descriptor);
    if (!failing) return result;
    errno = error;
    return -1;
}

int mkdir(const char* path, mode_t mode) {
    if (isBelow(path) && fails(kMkdir)) return -1;
    return ((int (*)(const char*, mode_t))next("mkdir"))(path, mode);
}

int mkdirat(int folder, const char* path, mode_t mode) {
    if (isBelowFrom(folder, path) && fails(kMkdir)) return -1;
    return ((int (*)(int, const char*, mode_t))next("mkdirat"))(folder, path, mode);
}

int unlinkat(int folder, const char* path, int flags) {
    if (isBelowFrom(folder, path) && (flags & AT_REMOVEDIR) == 0 && fails(kUnlink)) return -1;
    return ((int (*)(int, const char*, int))next("unlinkat"))(folder, path, flags);
}

int unlink(const char* path) {
    if (isBelow(path) && fails(kUnlink)) return -1;
    return ((int (*)(const char*))next("unlink"))(path);
}

int remove(const char* path) {
    if (isBelow(path) && fails(kUnlink)) return -1;
    return ((int (*)(const char*))next("remove"))(path);
}

static int truncateWatched(const char* function, int descriptor, off_t size) {
    if (isWatched(descriptor) && fails(kTruncate)) return -1;
    return ((int (*)(int, off_t))next(function))(descriptor, size);
}

int ftruncate(int descriptor, off_t size) {
    return truncateWatched("ftruncate", descriptor, size);
}

int ftruncate64(int descriptor, off64_t size) {
    return truncateWatched("ftruncate64", descriptor, size);
}

__attribute__((destructor)) static void writeCounts(void) {
    const char* path = getenv("FAIL_COUNTS");
    FILE* file = path != NULL ? fopen(path, "w") : NULL;
    if (file == NULL) return;
    for (int kind = 0; kind < kKinds; ++kind) fprintf(file, "%s %d\n", kNames[kind], counts[kind]);
    fclose(file);
}
