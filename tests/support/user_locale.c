/* Loaded before a program (LD_PRELOAD): takes the user's locale over, as libraries of windows and
 * input methods do behind a program's back. Prints "1,5" to the file named by LOCALE_SHOWS, where
 * that is what the locale makes of 1.5. */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

__attribute__((constructor)) static void takeOver(void) {
    setlocale(LC_ALL, "");
    const char* path = getenv("LOCALE_SHOWS");
    FILE* file = path != NULL ? fopen(path, "w") : NULL;
    if (file == NULL) return;
    fprintf(file, "%.1f", 1.5);
    fclose(file);
}
