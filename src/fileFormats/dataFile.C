// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataFile.H"

#include "fileNames.H"
#include <cmath>

namespace ispf
{

namespace
{

constexpr size_t timeWidth = 14;

word padded(word text)
{
    if (text.size() < timeWidth) text.append(timeWidth - text.size(), ' ');
    return text;
}

}  // namespace

word scientific(scalar value, int precision)
{
    if (std::isnan(value)) return "NaN";
    char text[48];
    std::snprintf(text, sizeof text, "%.*e", precision, value);
    return text;
}

dataFile::dataFile(const word& path, const List<word>& remarks, const List<word>& titles,
                   int precision)
    : path_(path), precision_(precision)
{
    for (const word& remark : remarks) header_ += "# " + remark + "\n";
    header_ += padded("# Time");
    for (const word& title : titles) header_ += "\t" + title;
    header_ += "\n";
}

// Replaces the file of an earlier run from the same start
void dataFile::open()
{
    writeText(path_, header_);
    file_.open(path_, std::ios::app);
}

dataFile& dataFile::begin(scalar time)
{
    if (!file_.is_open()) open();
    file_ << padded(str(time, 12));
    return *this;
}

dataFile& dataFile::operator<<(scalar value)
{
    file_ << '\t' << scientific(value, precision_);
    return *this;
}

dataFile& dataFile::operator<<(const vector& value)
{
    file_ << "\t(" << scientific(value[0], precision_) << ' ' << scientific(value[1], precision_)
          << ' ' << scientific(value[2], precision_) << ')';
    return *this;
}

void dataFile::endRow()
{
    file_ << std::endl;
    if (!file_) throw fatalError("Cannot write " + path_ + ". Is the disk full?");
}

}  // namespace ispf
