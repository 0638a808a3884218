//! Files written here, read back: every form of geometry that the format has, against positions counted by hand.
