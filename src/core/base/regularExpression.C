// SPDX-License-Identifier: GPL-3.0-or-later
#include "regularExpression.H"

#include <re2/re2.h>

namespace ispf
{

regularExpression::regularExpression(const word& text, const fileLocation& where)
{
    re2::RE2::Options options;
    options.set_log_errors(false);
    options.set_max_mem(1 << 20);
    options.set_encoding(re2::RE2::Options::EncodingLatin1);  // bytes, as in POSIX
    options.set_dot_nl(true);
    expression_ = std::make_shared<const re2::RE2>(text, options);
    if (!expression_->ok())
        throw fatalError(
            "\"" + text + "\" is not a regular expression: " + expression_->error() + ".", where);
}

bool regularExpression::matches(const word& whole) const
{
    return re2::RE2::FullMatch(whole, *expression_);
}

size_t regularExpression::bytes() const
{
    return 1500 + 16 * size_t(expression_->ProgramSize());  // measured: 1300 and 11
}

bool regularExpression::isOne(const word& text)
{
    return text.find_first_of(".*+?()[]{}|^$\\") != word::npos;
}

}  // namespace ispf
