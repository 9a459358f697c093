"""Small XML files, written without lxml, which takes long to import."""

from swarmdsl.base.xml_writer import Element, document, legal

__all__ = ["Element", "document", "legal"]
