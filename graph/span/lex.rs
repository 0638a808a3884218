//! Text to tokens.

use super::value::Number;
use shadowgraph_core::problem::{Kind, Problem};

/// A token; `Open` and `Close` hold their character.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    Open(char),
    Close(char),
    Colon,
    Comma,
    Word(String),
    Text(String),
    Number(Number),
    End,
}

impl Token {
    /// As errors show it.
    pub fn text(&self) -> String {
        match self {
            Token::Open(c) | Token::Close(c) => format!("`{c}`"),
            Token::Colon => "`:`".into(),
            Token::Comma => "`,`".into(),
            Token::Word(word) => format!("`{word}`"),
            Token::Text(text) => format!("{text:?}"),
            Token::Number(number) => format!("`{}`", number.text),
            Token::End => "the end of the text".into(),
        }
    }
}

/// Why the text is not RON, with the bytes it concerns.
pub(super) type Fault = (usize, usize, Problem);

#[derive(Clone)]
pub(super) struct Lexer<'a> {
    text: &'a str,
    at: usize,
}

fn fault(start: usize, end: usize, message: &str) -> Fault {
    (start, end, Problem::new(Kind::Syntax, message))
}

impl<'a> Lexer<'a> {
    pub fn new(text: &'a str) -> Self {
        let at = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        Self { text, at }
    }

    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Steps over `count` bytes, which end at a character's end.
    fn skip(&mut self, count: usize) {
        self.at += count;
    }

    /// The next token and its bytes.
    pub fn next(&mut self) -> Result<(Token, usize, usize), Fault> {
        self.skip_blanks()?;
        let start = self.at;
        let Some(first) = self.peek() else { return Ok((Token::End, start, start)) };
        let token = match first {
            '(' | '[' | '{' => self.single(Token::Open(first)),
            ')' | ']' | '}' => self.single(Token::Close(first)),
            ':' => self.single(Token::Colon),
            ',' => self.single(Token::Comma),
            '"' => self.string()?,
            'r' if self.rest().starts_with("r\"") || self.rest().starts_with("r#") => self.raw_string()?,
            '0'..='9' | '+' | '-' | '.' => self.number()?,
            c if c == '_' || c.is_alphabetic() => self.word()?,
            '#' => return Err(fault(start, start + 1, "attributes are not used in graph files")),
            c => {
                return Err(fault(start, start + c.len_utf8(), &format!("unexpected character {c:?}")));
            }
        };
        Ok((token, start, self.at))
    }

    fn single(&mut self, token: Token) -> Token {
        self.skip(1);
        token
    }

    /// Steps over white space, `// ..` and nested `/* .. */`.
    fn skip_blanks(&mut self) -> Result<(), Fault> {
        loop {
            let rest = self.rest();
            self.skip(rest.len() - rest.trim_start().len());
            let rest = self.rest();
            if rest.starts_with("//") {
                self.skip(rest.find('\n').unwrap_or(rest.len()));
            } else if rest.starts_with("/*") {
                self.block_comment()?;
            } else {
                return Ok(());
            }
        }
    }

    fn block_comment(&mut self) -> Result<(), Fault> {
        let start = self.at;
        let mut depth = 0usize;
        loop {
            let rest = self.rest();
            if rest.starts_with("/*") {
                depth += 1;
                self.skip(2);
            } else if rest.starts_with("*/") {
                depth -= 1;
                self.skip(2);
                if depth == 0 {
                    return Ok(());
                }
            } else if let Some(c) = rest.chars().next() {
                self.skip(c.len_utf8());
            } else {
                return Err(fault(start, start + 2, "comment `/*` is never closed"));
            }
        }
    }

    fn word(&mut self) -> Result<Token, Fault> {
        let rest = self.rest();
        let end = rest.find(|c: char| !(c == '_' || c.is_alphanumeric())).unwrap_or(rest.len());
        let word = &rest[..end];
        self.skip(end);
        Ok(match word {
            "inf" | "NaN" => {
                Token::Number(Number { text: word.into(), whole: None, real: word.parse().unwrap_or(f64::NAN) })
            }
            _ => Token::Word(word.into()),
        })
    }

    fn number(&mut self) -> Result<Token, Fault> {
        let start = self.at;
        let mut before = '\0';
        let rest = self.rest();
        let based = rest.trim_start_matches(['+', '-']).starts_with("0x");
        let end = rest
            .char_indices()
            .find(|(at, c)| {
                let sign = matches!(c, '+' | '-') && (*at == 0 || (!based && matches!(before, 'e' | 'E')));
                before = *c;
                !(sign || c.is_ascii_alphanumeric() || matches!(c, '.' | '_'))
            })
            .map_or(rest.len(), |(at, _)| at);
        let text = &rest[..end];
        self.skip(end);
        let wrong = || fault(start, start + end.max(1), &format!("`{text}` is not a number"));
        let plain = text.replace('_', "");
        let whole = whole_number(&plain);
        let real = match whole {
            Some(value) => value as f64,
            // Rust also takes `infinity` and `nan`, which RON does not.
            None if plain.trim_start_matches(['+', '-']).starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
                plain.parse().map_err(|_| wrong())?
            }
            None if matches!(plain.trim_start_matches(['+', '-']), "inf" | "NaN") => {
                plain.parse().map_err(|_| wrong())?
            }
            None => return Err(wrong()),
        };
        Ok(Token::Number(Number { text: text.into(), whole, real }))
    }

    fn string(&mut self) -> Result<Token, Fault> {
        let start = self.at;
        self.skip(1);
        let mut value = String::new();
        loop {
            let Some(c) = self.peek() else { return Err(fault(start, start + 1, "string is never closed")) };
            let at = self.at;
            self.skip(c.len_utf8());
            match c {
                '"' => return Ok(Token::Text(value)),
                '\\' => match self.escape() {
                    Some(Some(c)) => value.push(c),
                    Some(None) => {}
                    None => return Err(fault(at, at + 1, "unknown escape in a string")),
                },
                c => value.push(c),
            }
        }
    }

    /// What stands after a backslash: a character, or a line end and the blanks after it, which mean nothing.
    fn escape(&mut self) -> Option<Option<char>> {
        let c = self.peek()?;
        self.skip(c.len_utf8());
        Some(Some(match c {
            'n' => '\n',
            't' => '\t',
            'r' => '\r',
            '0' => '\0',
            '\\' | '"' | '\'' => c,
            'x' => self.code_point(2)?,
            'u' => {
                self.take('{')?;
                let length = self.rest().find('}').filter(|length| (1..=6).contains(length))?;
                let c = self.code_point(length)?;
                self.take('}')?;
                c
            }
            '\n' => {
                let rest = self.rest();
                self.skip(rest.len() - rest.trim_start().len());
                return Some(None);
            }
            _ => return None,
        }))
    }

    fn take(&mut self, wanted: char) -> Option<()> {
        (self.peek()? == wanted).then(|| self.skip(wanted.len_utf8()))
    }

    fn code_point(&mut self, digits: usize) -> Option<char> {
        let text = self.rest().get(..digits).filter(|text| text.bytes().all(|b| b.is_ascii_hexdigit()))?;
        self.skip(digits);
        char::from_u32(u32::from_str_radix(text, 16).ok()?)
    }

    fn raw_string(&mut self) -> Result<Token, Fault> {
        let start = self.at;
        let after = &self.rest()[1..];
        let hashes = after.len() - after.trim_start_matches('#').len();
        let wrong = || fault(start, start + 1, "raw string is never closed");
        let body = after[hashes..].strip_prefix('"').ok_or_else(wrong)?;
        let close = format!("\"{}", "#".repeat(hashes));
        let length = body.find(&close).ok_or_else(wrong)?;
        self.skip(1 + hashes + 1 + length + close.len());
        Ok(Token::Text(body[..length].into()))
    }
}

/// A number without point or exponent, in base 2, 8, 10 or 16.
fn whole_number(plain: &str) -> Option<i128> {
    let (sign, digits) = match plain.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, plain.strip_prefix('+').unwrap_or(plain)),
    };
    let (digits, base) = match digits.get(..2) {
        Some("0x") => (&digits[2..], 16),
        Some("0o") => (&digits[2..], 8),
        Some("0b") => (&digits[2..], 2),
        _ => (digits, 10),
    };
    let plain = digits.bytes().all(|b| b.is_ascii_alphanumeric());
    i128::from_str_radix(digits, base).ok().filter(|_| plain).map(|value| sign * value)
}
