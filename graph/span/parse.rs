//! Tokens to a tree.

use super::lex::{Fault, Lexer, Token};
use super::value::{Data, Field, Tree};
use crate::source::{Findings, MAX_TEXT_BYTES, Span};
use shadowgraph_core::problem::{Kind, Problem};

/// Deepest nesting that is read; graph files need five.
const MAX_DEPTH: usize = 32;

struct Parser<'a> {
    lexer: Lexer<'a>,
    file: u32,
    token: Token,
    start: usize,
    end: usize,
    depth: usize,
    findings: &'a mut Findings,
}

/// The tree of text number `file`, or none when the text is no RON; either way what is wrong goes to `findings`.
pub(crate) fn parse(text: &str, file: u32, findings: &mut Findings) -> Option<Tree> {
    if text.len() > MAX_TEXT_BYTES {
        let problem = Problem::new(Kind::Syntax, "graph text is too long")
            .expected(format!("at most {MAX_TEXT_BYTES} bytes"))
            .found(format!("{} bytes", text.len()));
        findings.push(Span::new(file, 0, 0), problem);
        return None;
    }
    let mut found = Findings::default();
    let tree = whole(text, file, &mut found);
    let body = text.strip_prefix('\u{feff}').unwrap_or(text);
    if found.is_empty()
        && let Err(error) = ron::from_str::<ron::Value>(body)
    {
        // We took what RON does not: RON decides, or files would not be readable elsewhere.
        let start = text.len() - body.len() + byte_of(body, error.span.start.line, error.span.start.col);
        found.push(Span::new(file, start, start), Problem::new(Kind::Syntax, error.code.to_string()));
        findings.extend(&found);
        return None;
    }
    findings.extend(&found);
    tree
}

/// A single value such as a flag holds; none when it is no value.
pub(crate) fn parse_fragment(text: &str) -> Option<Data> {
    let mut findings = Findings::default();
    let tree = if text.len() > MAX_TEXT_BYTES { None } else { whole(text, 0, &mut findings) };
    tree.filter(|_| findings.is_empty()).map(|tree| tree.data)
}

fn whole(text: &str, file: u32, findings: &mut Findings) -> Option<Tree> {
    let mut parser = Parser { lexer: Lexer::new(text), file, token: Token::End, start: 0, end: 0, depth: 0, findings };
    let result = parser.advance().and_then(|()| parser.value()).and_then(|tree| match parser.token {
        Token::End => Ok(tree),
        _ => Err(parser.unexpected("the end of the text")),
    });
    match result {
        Ok(tree) => Some(tree),
        Err((start, end, problem)) => {
            parser.findings.push(Span::new(file, start, end), problem);
            None
        }
    }
}

fn byte_of(text: &str, line: usize, column: usize) -> usize {
    let line_start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let rest = &text[line_start..];
    line_start + rest.char_indices().nth(column.saturating_sub(1)).map_or(rest.len(), |(at, _)| at)
}

impl Parser<'_> {
    fn advance(&mut self) -> Result<(), Fault> {
        (self.token, self.start, self.end) = self.lexer.next()?;
        Ok(())
    }

    fn unexpected(&self, expected: &str) -> Fault {
        let problem = Problem::new(Kind::Syntax, "cannot read this").expected(expected).found(self.token.text());
        (self.start, self.end, problem)
    }

    fn span(&self) -> Span {
        Span::new(self.file, self.start, self.end)
    }

    fn value(&mut self) -> Result<Tree, Fault> {
        let span = self.span();
        let data = match std::mem::replace(&mut self.token, Token::End) {
            Token::Open(open) => return self.nested(open, span),
            Token::Number(number) => Data::Number(number),
            Token::Text(text) => Data::Text(text),
            Token::Word(word) => match word.as_str() {
                "true" => Data::Bool(true),
                "false" => Data::Bool(false),
                _ => {
                    self.advance()?;
                    // `Name(..)` is the struct alone: graph files have no use for its name.
                    return match self.token {
                        Token::Open('(') => self.nested('(', span),
                        _ => Ok(Tree { span, data: Data::Word(word) }),
                    };
                }
            },
            other => {
                self.token = other;
                return Err(self.unexpected("a value"));
            }
        };
        self.advance()?;
        Ok(Tree { span, data })
    }

    /// The current token is the opening one, or stood at `span` and was taken.
    fn nested(&mut self, open: char, span: Span) -> Result<Tree, Fault> {
        let opened = (self.start, self.end);
        if self.depth == MAX_DEPTH {
            let problem = Problem::new(Kind::Syntax, format!("nested deeper than {MAX_DEPTH} levels"));
            return Err((self.start, self.end, problem));
        }
        self.depth += 1;
        self.advance()?;
        let data = match open {
            '[' => Data::List(self.items(']', opened, Self::value)?),
            '{' => Data::Map(self.items('}', opened, Self::pair)?),
            _ => self.round(opened)?,
        };
        let tree = Tree { span: span.to(self.span()), data };
        self.depth -= 1;
        self.advance()?;
        Ok(tree)
    }

    /// Items up to the closing token, which stays current. A missing comma is told and read over.
    fn items<T>(
        &mut self,
        close: char,
        opened: (usize, usize),
        item: fn(&mut Self) -> Result<T, Fault>,
    ) -> Result<Vec<T>, Fault> {
        let mut items = Vec::new();
        loop {
            match &self.token {
                Token::Close(c) if *c == close => return Ok(items),
                Token::End => {
                    let problem = Problem::new(Kind::Syntax, "bracket is never closed").expected(format!("`{close}`"));
                    return Err((opened.0, opened.1, problem.found(Token::End.text())));
                }
                _ => {}
            }
            items.push(item(self)?);
            match &self.token {
                Token::Comma => self.advance()?,
                Token::Word(_) | Token::Text(_) | Token::Number(_) | Token::Open(_) => {
                    let (start, end, problem) = self.unexpected(&format!("`,` or `{close}`"));
                    self.findings.push(Span::new(self.file, start, end), problem);
                }
                Token::Close(c) if *c != close => return Err(self.unexpected(&format!("`,` or `{close}`"))),
                Token::Colon => return Err(self.unexpected(&format!("`,` or `{close}`"))),
                _ => {}
            }
        }
    }

    fn pair(&mut self) -> Result<(Tree, Tree), Fault> {
        let key = self.value()?;
        self.colon()?;
        Ok((key, self.value()?))
    }

    fn colon(&mut self) -> Result<(), Fault> {
        match self.token {
            Token::Colon => self.advance(),
            _ => Err(self.unexpected("`:`")),
        }
    }

    /// A struct if the first item is `name:`, else a tuple.
    fn round(&mut self, opened: (usize, usize)) -> Result<Data, Fault> {
        let named = matches!(self.token, Token::Close(')')) || {
            // `(version 1` lacks a colon, not a comma.
            let is_name = |next| !matches!(next, Token::Comma | Token::Open(_) | Token::Close(_) | Token::End);
            matches!(self.token, Token::Word(_)) && self.lexer.clone().next().is_ok_and(|(next, ..)| is_name(next))
        };
        if named {
            Ok(Data::Struct(self.items(')', opened, Self::field)?))
        } else {
            Ok(Data::Tuple(self.items(')', opened, Self::value)?))
        }
    }

    fn field(&mut self) -> Result<Field, Fault> {
        let span = self.span();
        let Token::Word(name) = self.token.clone() else { return Err(self.unexpected("a field name")) };
        self.advance()?;
        self.colon()?;
        Ok(Field { name, span, value: self.value()? })
    }
}
