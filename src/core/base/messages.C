// SPDX-License-Identifier: GPL-3.0-or-later
#include "messages.H"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <limits>
#include <map>
#include <mutex>
#include <new>
#include <utility>

namespace ispf
{

namespace
{

int outputError = 0;  // errno of the first write to stdout that failed

// Keeps freed memory in the program: lists of a step come again in the next step, and returned memory would be cleared
// for each of them
void keepMemory()
{
    mallopt(M_MMAP_MAX, 0), mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

// A log that cannot be written does not stop a run: runMain reports it at the end
void note(bool written)
{
    if (!written && outputError == 0) outputError = errno != 0 ? errno : EIO;
}

// Hands characters to stdout and flushes at each end of line
class lineFlushingBuffer : public std::streambuf
{
protected:
    int_type overflow(int_type c) override
    {
        if (c == traits_type::eof()) return c;
        note(std::fputc(c, stdout) != EOF);
        if (c == '\n') sync();
        return c;
    }
    std::streamsize xsputn(const char* s, std::streamsize n) override
    {
        note(std::fwrite(s, 1, size_t(n), stdout) == size_t(n));
        if (std::find(s, s + n, '\n') != s + n) sync();
        return n;
    }
    int sync() override
    {
        note(std::fflush(stdout) == 0);
        return 0;
    }
};

int editDistance(const word& a, const word& b)
{
    List<int> row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = int(j);
    for (size_t i = 1; i <= a.size(); ++i)
    {
        int diagonal = row[0];
        row[0] = int(i);
        for (size_t j = 1; j <= b.size(); ++j)
        {
            const int above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
            diagonal = above;
        }
    }
    return row[b.size()];
}

word placeText(const fileLocation& w)
{
    word text = "file: " + w.file + (w.scope.empty() ? "" : "." + w.scope);
    if (w.lineEnd > w.line)
        text += " from line " + std::to_string(w.line) + " to line " + std::to_string(w.lineEnd);
    else if (w.line > 0) text += " at line " + std::to_string(w.line);
    return text + ".";
}

// Prints to stderr; also to the log, if stderr is a terminal and stdout is not
void complain(const word& text)
{
    if (::isatty(STDERR_FILENO) && !::isatty(STDOUT_FILENO)) std::fputs(text.c_str(), stdout);
    note(std::fflush(stdout) == 0);
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

int report(const fatalError& error)
{
    complain(
        (error.hasLocation() ? "\n--> FOAM FATAL IO ERROR: \n" : "\n--> FOAM FATAL ERROR: \n") +
        formatted(error) + "\n\nFOAM exiting\n\n");
    return 1;
}

// Opens missing standard streams, so that no file of the program takes their place
void occupyStandardStreams()
{
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0)
            ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

int statusOf(const std::function<int()>& body)
{
    try
    {
        return body();
    }
    catch (const fatalError& e)
    {
        return report(e);
    }
    catch (const std::bad_alloc&)
    {
        return report(fatalError("Out of memory. Use fewer particles or more memory."));
    }
    catch (const std::exception& e)
    {
        return report(fatalError(e.what()));
    }
    catch (const std::string& e)  // gmsh throws plain strings
    {
        return report(fatalError(e));
    }
    catch (...)
    {
        return report(fatalError("An exception of unknown type ended the program."));
    }
}

}  // namespace

word formatted(const fatalError& error)
{
    return error.what() + (error.hasLocation() ? "\n\n" + placeText(error.location()) : "");
}

word validWords(const word& what, List<word> words)
{
    if (words.empty()) return "There is no " + what;
    std::sort(words.begin(), words.end());
    const char last = what.empty() ? ' ' : what.back();
    const char* plural = last == 's' ? "" : last == 'h' || last == 'x' ? "es" : "s";
    return "Valid " + what + plural + " are: " + join(words);
}

word didYouMean(const word& given, const List<word>& known)
{
    const word* best = nullptr;
    int least = 1 + int(given.size()) / 3;
    for (const word& k : known)
        if (const int d = editDistance(given, k); d <= least && k != given)
            if (d < least || !best) best = &k, least = d;
    return best ? " Did you mean '" + *best + "'?" : "";
}

std::ostream& info()
{
    static lineFlushingBuffer buffer;
    static std::ostream stream(&buffer);
    return stream;
}

void warning(const word& text, int most)
{
    static std::mutex guard;
    static std::map<word, int> count;
    const std::lock_guard<std::mutex> lock(guard);
    const int n = ++count[text];
    if (n > most) return;
    const bool last = n == most && most > 1;
    complain("--> FOAM Warning : " + text + "\n" +
             (last ? "    (not repeated from here on)\n" : ""));
}

int runMain(const std::function<int()>& body)
{
    occupyStandardStreams();
    keepMemory();
    const int status = statusOf(body);
    note(std::fflush(stdout) == 0);
    if (outputError == 0) return status;
    const word reason = std::strerror(std::exchange(outputError, 0));
    report(fatalError("The output could not be written to stdout: " + reason +
                      ".\nA part of it is lost. Files of their own that the program "
                      "wrote are whole."));
    return status != 0 ? status : 1;
}

word str(double value, int digits)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
}

word join(const List<word>& words, const word& separator)
{
    word all;
    for (size_t i = 0; i < words.size(); ++i) all += (i ? separator : "") + words[i];
    return all;
}

}  // namespace ispf
