"""What the engines share: interface, outline of the object, support, friction of the table."""
